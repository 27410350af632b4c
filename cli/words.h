/* cli/words.h - numbers, lengths and choices in the words of a command line (cli only). Each is
 * false for anything else: for a word with something behind it, too, for hexadecimal digits, nan.
 */
#ifndef KTG_CLI_WORDS_H
#define KTG_CLI_WORDS_H

#include <stdbool.h>
#include <stdint.h>

/* A decimal number from least to most. */
bool cli_parse_number(const char *text, double least, double most, double *number);

/* The same with, perhaps, a unit behind it. */
bool cli_parse_amount(const char *text, const char *unit, double least, double most,
                      double *amount);

/* A count in digits. */
bool cli_parse_count(const char *text, uint64_t least, uint64_t most, uint64_t *count);
bool cli_parse_count32(const char *text, uint32_t least, uint32_t *count);

/* "180mm", "18cm", "7in", "0.3m", bare numbers are millimetres. */
bool cli_parse_length(const char *text, double *mm);

/* The place of `text` in a list of words that ends with NULL; -1 when it is not there. */
int cli_word_index(const char *text, const char *const *words);

#endif
