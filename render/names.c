/* render/names.c - what pieces and tiles are called, on the sheets and in a reader's outline. */
#include "render/draw.h"
#include "render/poster.h"
#include "render/text.h"

#include <stdio.h>

void ktg_drawing_piece_part(const ktg_drawing *drawing, uint32_t piece, char part[KTG_NAME_SIZE]) {
    const ktg_pattern *pattern = drawing->pattern;
    unsigned count = 0, place = 0;
    for (uint32_t i = 0; i < pattern->piece_count; i++)
        if (pattern->pieces[i].component == pattern->pieces[piece].component) {
            count++;
            place += i <= piece;
        }
    *part = 0;
    if (count > 1)
        snprintf(part, KTG_NAME_SIZE, "%u of %u", place, count);
}

void ktg_drawing_piece_name(const ktg_drawing *drawing, uint32_t piece, char name[KTG_NAME_SIZE]) {
    const ktg_pattern_piece *p = &drawing->pattern->pieces[piece];
    char clean[KTG_NAME_SIZE - 32], part[KTG_NAME_SIZE];
    ktg_text_clean(p->name ? p->name : "", SIZE_MAX, clean, sizeof clean);
    ktg_drawing_piece_part(drawing, piece, part);
    if (drawing->pattern->mode == KTG_CLOTH)
        *part = 0; /* every panel has a name of its own */
    if (!*clean)
        snprintf(name, KTG_NAME_SIZE, "piece %u", piece + 1);
    else
        snprintf(name, KTG_NAME_SIZE, "%s%s%.30s", clean, *part ? " " : "", part);
}

bool ktg_is_tile(const ktg_pattern_sheet *sheet) {
    return sheet->kind == KTG_TILE && sheet->poster > 0 && sheet->placement_count > 0;
}

uint32_t ktg_poster_count(const ktg_pattern *pattern) {
    uint32_t count = 0;
    for (size_t s = 0; s < pattern->sheet_count; s++)
        if (ktg_is_tile(&pattern->sheets[s]) && pattern->sheets[s].poster > count)
            count = pattern->sheets[s].poster;
    return count;
}

/* A, B, ... Z, AA, AB, ... as columns of a spreadsheet are called. */
static void row_name(uint32_t row, char name[8]) {
    char letters[8];
    int length = 0;
    for (uint64_t n = (uint64_t)row + 1; n > 0; n = (n - 1) / 26)
        letters[length++] = (char)('A' + (n - 1) % 26);
    for (int i = 0; i < length; i++)
        name[i] = letters[length - 1 - i];
    name[length] = 0;
}

void ktg_tile_name(const ktg_drawing *drawing, const ktg_pattern_sheet *sheet,
                   char name[KTG_NAME_SIZE]) {
    char row[8];
    row_name(sheet->row, row);
    if (ktg_poster_count(drawing->pattern) > 1)
        snprintf(name, KTG_NAME_SIZE, "%u-%s%u", sheet->poster, row, sheet->column + 1);
    else
        snprintf(name, KTG_NAME_SIZE, "%s%u", row, sheet->column + 1);
}

const ktg_pattern_sheet *ktg_tile_neighbour(const ktg_drawing *drawing,
                                            const ktg_pattern_sheet *sheet, int down, int right) {
    const ktg_pattern *pattern = drawing->pattern;
    for (size_t s = 0; s < pattern->sheet_count; s++) {
        const ktg_pattern_sheet *other = &pattern->sheets[s];
        if (ktg_is_tile(other) && other->poster == sheet->poster &&
            (int64_t)other->row == (int64_t)sheet->row + down &&
            (int64_t)other->column == (int64_t)sheet->column + right)
            return other;
    }
    return NULL;
}
