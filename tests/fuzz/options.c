/* tests/fuzz/options.c - any words as the command line of any command: the first byte chooses it, a
 * byte of 0 or a newline ends a word. */
#include "cli/cli.h"
#include "tests/fuzz/fuzz.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#define MOST_WORDS 40

/* What the command line complains about is not worth a look. */
static void be_quiet(void) {
    static bool quiet;
    if (quiet)
        return;
    stderr = fopen("/dev/null", "w");
    quiet = stderr != NULL;
    fuzz_expect(quiet, "no /dev/null");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_bytes bytes = {data, size};
    int command = 1 << fuzz_below(&bytes, 7), argc = 1;
    char *argv[MOST_WORDS + 1] = {"fuzz"};
    settings s;
    be_quiet();
    char *text = calloc(bytes.left + 1, 1), *rest = NULL;
    memcpy(text, bytes.at, bytes.left);
    for (size_t i = 0; i < bytes.left; i++)
        if (text[i] == 0)
            text[i] = '\n';
    for (char *word = strtok_r(text, "\n", &rest); word && argc < MOST_WORDS;
         word = strtok_r(NULL, "\n", &rest))
        argv[argc++] = word;
    if (cli_read_options(argc, argv, command, 1, 2, &s) && !s.help) {
        fuzz_expect(s.argument_count >= 1 && s.argument_count <= 2, "too few or too many files");
        fuzz_expect(s.pipeline.size_mm >= 0 && s.pipeline.overlap_mm >= 0 &&
                        s.pipeline.layout.gap_mm >= 0 && s.pipeline.layout.sheet.margin_mm >= 0 &&
                        s.pipeline.finish.tab_height_mm >= 0 &&
                        s.pipeline.finish.allowance_mm >= 0 && s.pipeline.finish.hem_mm >= 0,
                    "a length below 0 is taken");
    }
    free(text);
    return 0;
}
