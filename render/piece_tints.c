/* render/piece_tints.c - a pale colour for each piece, on the sheets and in the pictures. */
#include "render/draw.h"

#include "core/memory.h"

/* Told apart by those who see few colours, and in grey by their brightness. */
static const uint32_t tints[] = {0xfbe3a4, 0xa9d3ee, 0xf2c3a0, 0xbfe3c9,
                                 0xd9c4e6, 0xf4f0d6, 0x9fc3b4, 0xe8b8c4};
#define PAPER 0xf6efe0 /* of a single piece */
#define TINTS (sizeof tints / sizeof *tints)

uint32_t ktg_drawing_colour(const ktg_drawing *drawing, uint32_t colour) {
    if (drawing->options.colour)
        return colour;
    uint32_t red = colour >> 16 & 255, green = colour >> 8 & 255, blue = colour & 255;
    uint32_t grey = (30 * red + 59 * green + 11 * blue) / 100;
    return grey << 16 | grey << 8 | grey;
}

/* The colour that a piece's neighbours have least, and of those the one others have least. */
static uint32_t choose(const uint32_t near[TINTS], const uint32_t used[TINTS]) {
    uint32_t best = 0;
    for (uint32_t k = 1; k < TINTS; k++)
        if (near[k] < near[best] || (near[k] == near[best] && used[k] < used[best]))
            best = k;
    return best;
}

ktg_status ktg_drawing_find_tints(ktg_drawing *drawing) {
    const ktg_pattern *pattern = drawing->pattern;
    uint32_t used[TINTS] = {0};
    uint32_t(*near)[TINTS] = ktg_alloc(drawing->context, pattern->piece_count, sizeof *near);
    drawing->piece_tints = ktg_new(drawing->context, pattern->piece_count, uint32_t);
    ktg_status status = near && drawing->piece_tints ? KTG_OK : KTG_MEMORY;
    for (uint32_t p = 0; status == KTG_OK && p < pattern->piece_count; p++) {
        uint32_t best = choose(near[p], used);
        used[best]++;
        drawing->piece_tints[p] =
            ktg_drawing_colour(drawing, pattern->piece_count > 1 ? tints[best] : PAPER);
        for (size_t s = 0; s < pattern->seam_count; s++) {
            const uint32_t *pieces = pattern->seams[s].pieces;
            if (pieces[0] == p || pieces[1] == p)
                near[pieces[pieces[0] == p]][best]++;
        }
    }
    ktg_free(near);
    return status;
}
