/* pattern/label_name.c - the name of a piece, where there is most room for it. */
#include "pattern/label_box.h"

#include <stdio.h>
#include <string.h>

/* Digits of a name are this high at most, in mm. */
#define PAPER_NAME_MM  3.6
#define ACROSS_NAME_MM 2.4 /* over folds, of which it should not hide much */
#define SHRINK         0.9

/* At most this many faces are looked at. */
#define MOST_FACES 400

/* The most bytes of a label and its end. */
#define TEXT_SIZE sizeof((ktg_pattern_label){0}.text)

/* Which piece of its component it is: "2 of 3", or nothing where it is the only one. */
static void part_text(const ktg_pattern *pattern, uint32_t p, char text[TEXT_SIZE]) {
    unsigned count = 0, place = 0;
    for (uint32_t i = 0; i < pattern->piece_count; i++) {
        if (pattern->pieces[i].component != pattern->pieces[p].component)
            continue;
        count++;
        place += i <= p;
    }
    *text = '\0';
    if (count > 1)
        snprintf(text, TEXT_SIZE, "%u of %u", place, count);
}

/* "body" or, of several pieces, "body 2 of 3"; cut to fit between characters. */
static void name_text(const ktg_pattern *pattern, uint32_t p, const char *part,
                      char text[TEXT_SIZE]) {
    const ktg_pattern_piece *piece = &pattern->pieces[p];
    const char *name = piece->component < pattern->component_count
                           ? pattern->components[piece->component].name
                           : NULL;
    size_t part_length = strlen(part), length = name ? strlen(name) : 0;
    size_t room = TEXT_SIZE - 1 - part_length - (part_length > 0);
    if (length > room)
        length = room;
    while (length > 0 && ((unsigned char)name[length] & 0xc0) == 0x80)
        length--;
    if (length > 0)
        memcpy(text, name, length);
    if (length > 0 && part_length > 0)
        text[length++] = ' ';
    memcpy(text + length, part, part_length);
    text[length + part_length] = '\0';
}

/* True when a box on `face` lies across no border and, unless `across_folds`, across no fold around
 * the flat region. */
static bool lies_clear(ktg_label_sheet *sheet, uint32_t p, uint32_t face, bool across_folds,
                       const ktg_label_box *box) {
    const ktg_topology *t = sheet->topology;
    const ktg_pattern_piece *piece = &sheet->pattern->pieces[p];
    if (ktg_label_on_border(sheet, p, box))
        return false;
    if (across_folds)
        return true;
    uint32_t region = t->region_of[face];
    bool alone = t->region_size[region] == 1;
    for (size_t i = 0; i < (alone ? 3 : 3 * piece->face_count); i++) {
        uint32_t h = 3 * (alone ? face : piece->faces[i / 3]) + (uint32_t)(i % 3);
        if (t->region_of[h / 3] == region && ktg_edge_at(t, h)->kind != KTG_EDGE_FLAT &&
            ktg_label_box_cut(box, ktg_start_of(t, h), ktg_end_of(t, h)))
            return false;
    }
    return true;
}

static ktg_vec2 incentre(const ktg_topology *t, uint32_t face) {
    ktg_vec2 sum = {0, 0};
    double weight = 0;
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t opposite = 3 * face + (k + 1) % 3;
        double length = ktg_length2(ktg_sub2(ktg_end_of(t, opposite), ktg_start_of(t, opposite)));
        sum = ktg_madd2(sum, length, ktg_corner_at(t, 3 * face + k));
        weight += length;
    }
    return weight > 0 ? ktg_mul2(sum, 1 / weight) : ktg_corner_at(t, 3 * face);
}

/* A name that looks for its place. */
typedef struct name_search {
    ktg_label_sheet *sheet;
    uint32_t piece;
    ktg_vec2 middle;   /* of the piece */
    double wide;       /* the text's width over its height */
    double most;       /* the height wished for */
    bool across_folds; /* where there is no other place */
} name_search;

/* How many candidates a face has. */
static uint32_t candidate_count(const name_search *search) {
    return search->across_folds ? 9 : 6;
}

/* Text that does not stand on its head. */
static ktg_vec2 readable(ktg_vec2 along) {
    return along.x < 0 || (along.x == 0 && along.y < 0) ? ktg_mul2(along, -1) : along;
}

/* A candidate: the text in the middle of a face along one of its sides; from the third
 * on in the middle of a side the name may lie across, along the next side, then upright to
 * it. */
static ktg_label_box candidate(const name_search *search, uint32_t face, uint32_t k) {
    const ktg_topology *t = search->sheet->topology;
    uint32_t side = 3 * face + k % 3;
    ktg_vec2 a = ktg_start_of(t, side), b = ktg_end_of(t, side), along = ktg_sub2(b, a);
    ktg_edge_kind kind = ktg_edge_at(t, side)->kind;
    bool crossable = search->across_folds ? t->place_of[side] == KTG_NONE : kind == KTG_EDGE_FLAT;
    ktg_vec2 at = incentre(t, face);
    if (k >= 3 && crossable) {
        at = ktg_mul2(ktg_add2(a, b), 0.5);
        along = k >= 6 ? ktg_perp2(along) : ktg_sub2(ktg_end_of(t, ktg_next_corner(side)), b);
    }
    return (ktg_label_box){at, readable(ktg_unit2(along)), {0, 0}};
}

static bool fits(const name_search *search, uint32_t face, double mm, ktg_label_box *box) {
    box->half = (ktg_vec2){search->wide * mm / 2, mm / 2};
    return lies_clear(search->sheet, search->piece, face, search->across_folds, box) &&
           !ktg_label_piece_taken(search->sheet, search->piece, box);
}

/* The largest height, more than `least`, at which the text fits the candidate's place; 0: none. */
static double fitting_height(const name_search *search, uint32_t face, double least,
                             ktg_label_box *box) {
    if (!fits(search, face, least, box))
        return 0;
    for (double mm = search->most; mm > least; mm *= SHRINK)
        if (fits(search, face, mm, box))
            return mm;
    return 0;
}

/* The best place found so far. */
typedef struct name_place {
    ktg_label_box box;
    uint32_t face;
    double height; /* 0: it does not fit anywhere yet */
    double away;   /* squared distance to the piece's middle */
} name_place;

static ktg_vec2 middle_of(const ktg_pattern_piece *piece) {
    ktg_box box = ktg_box_of(piece->vertices, piece->vertex_count);
    return ktg_mul2(ktg_add2(box.low, box.high), 0.5);
}

/* Keeps the candidate where it is higher, or as high and nearer to the middle. */
static void consider(const name_search *search, uint32_t face, uint32_t k, name_place *best) {
    ktg_label_box box = candidate(search, face, k);
    ktg_vec2 v = ktg_sub2(box.at, search->middle);
    double away = ktg_dot2(v, v), least = fmax(best->height, 0.999 * KTG_LABEL_LEAST_MM);
    if (best->height >= search->most && away >= best->away)
        return;
    double mm = fitting_height(search, face, least * (1 - 1e-9), &box);
    if (mm > best->height * (1 + 1e-9) || (mm >= search->most && away < best->away))
        *best = (name_place){box, face, mm, away};
}

static name_place best_place(const name_search *search) {
    const ktg_pattern_piece *piece = &search->sheet->pattern->pieces[search->piece];
    name_place best = {.face = KTG_NONE, .away = INFINITY};
    size_t step = piece->face_count / MOST_FACES + 1;
    for (size_t i = 0; i < piece->face_count; i += step)
        for (uint32_t k = 0; k < candidate_count(search); k++)
            consider(search, piece->faces[i], k, &best);
    return best;
}

/* The whole name between the folds, across them, then only which part it is; a piece too small for
 * that goes without: its seams have numbers. */
static ktg_status name_paper(ktg_context *context, name_search *search, const char *text,
                             const char *part) {
    for (int attempt = 0; attempt < 4; attempt++) {
        const char *words = attempt < 2 ? text : part;
        if (!*words)
            break;
        search->wide = ktg_label_width(words);
        search->across_folds = attempt % 2 == 1;
        search->most = search->across_folds ? ACROSS_NAME_MM : PAPER_NAME_MM;
        name_place best = best_place(search);
        if (best.face != KTG_NONE)
            return ktg_label_write(context, search->sheet, search->piece, best.face, KTG_NONE,
                                   words, &best.box);
    }
    return KTG_OK;
}

ktg_status ktg_label_name(ktg_context *context, ktg_label_sheet *sheet, uint32_t p) {
    const ktg_pattern *pattern = sheet->pattern;
    const ktg_pattern_piece *piece = &pattern->pieces[p];
    char part[TEXT_SIZE], text[TEXT_SIZE];
    part_text(pattern, p, part);
    name_text(pattern, p, part, text);
    if (!*text || pattern->piece_count < 2 || piece->face_count == 0)
        return KTG_OK;
    name_search search = {.sheet = sheet, .piece = p, .middle = middle_of(piece)};
    return name_paper(context, &search, text, part);
}
