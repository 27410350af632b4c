/* pattern/json_seams.c - reading the seams of a pattern from JSON (docs/pattern-json.md). */
#include "core/memory.h"
#include "pattern/json_read.h"

/* Which side of edge i of a seam runs along the seam's side 0, where the file does not say: the
 * one in that piece; between two of the same piece the one whose end (or, for the last edge, whose
 * start) meets the neighbouring edge of the run. */
static uint8_t guess_side(const ktg_pattern *p, const ktg_pattern_seam *seam, uint32_t i) {
    const ktg_pattern_edge *edge = &p->edges[seam->edges[i]];
    if (edge->side_count < 2)
        return 0;
    if (edge->sides[0].piece != edge->sides[1].piece)
        return edge->sides[0].piece != seam->pieces[0];
    if (seam->edge_count < 2)
        return 0;
    bool last = i + 1 == seam->edge_count;
    const uint32_t *next = p->edges[seam->edges[last ? i - 1 : i + 1]].vertices;
    uint32_t meets = edge->vertices[last ? 0 : 1]; /* of side 0, which runs from [0] to [1] */
    return meets != next[0] && meets != next[1];
}

static ktg_status read_first_sides(const ktg_json *object, const ktg_json_reader *r,
                                   ktg_pattern_seam *seam) {
    ktg_json list, item;
    KTG_JSON_TAKE(object, seam->first_side, seam->edge_count, uint8_t);
    KTG_TRY(ktg_json_get_optional(object, "first_side", KTG_JSON_ARRAY, &list));
    if (list.value)
        KTG_TRY(ktg_json_expect_length(&list, seam->edge_count));
    for (uint32_t i = 0; i < seam->edge_count; i++) {
        uint32_t side = guess_side(r->pattern, seam, i);
        if (list.value) {
            KTG_TRY(ktg_json_item(&list, i, KTG_JSON_INTEGER, &item));
            KTG_TRY(ktg_json_below(&item, 2, &side));
        }
        seam->first_side[i] = (uint8_t)side;
    }
    return KTG_OK;
}

/* The second side lists the same edges, in the same order or backwards. */
static ktg_status check_second_side(const ktg_json *list, const ktg_json_reader *r,
                                    const ktg_pattern_seam *seam) {
    KTG_TRY(ktg_json_expect_length(list, seam->edge_count));
    bool same = true, backwards = true;
    for (uint32_t i = 0; i < seam->edge_count; i++) {
        ktg_json item;
        uint32_t edge;
        KTG_TRY(ktg_json_item(list, i, KTG_JSON_INTEGER, &item));
        KTG_TRY(ktg_json_ids_find(&r->edge_ids, &item, &edge));
        same = same && edge == seam->edges[i];
        backwards = backwards && edge == seam->edges[seam->edge_count - 1 - i];
    }
    return same || backwards ? KTG_OK
                             : ktg_json_refuse(list, "must be the edges of the other side");
}

static ktg_status read_seam_side(const ktg_json *sides, int s, const ktg_json_reader *r,
                                 ktg_pattern_seam *seam) {
    ktg_json side, list, item;
    KTG_TRY(ktg_json_item(sides, (size_t)s, KTG_JSON_OBJECT, &side));
    KTG_TRY(ktg_json_read_id(&side, "piece", &r->piece_ids, &seam->pieces[s]));
    KTG_TRY(ktg_json_number(&side, "length_mm", &seam->lengths_mm[s]));
    KTG_TRY(ktg_json_get(&side, "edges", KTG_JSON_ARRAY, &list));
    if (s == 1)
        return check_second_side(&list, r, seam);
    if (ktg_json_length(&list) == 0)
        return ktg_json_refuse(&list, "must not be empty");
    KTG_JSON_TAKE(&list, seam->edges, ktg_json_length(&list), uint32_t);
    seam->edge_count = (uint32_t)ktg_json_length(&list);
    for (uint32_t i = 0; i < seam->edge_count; i++) {
        KTG_TRY(ktg_json_item(&list, i, KTG_JSON_INTEGER, &item));
        KTG_TRY(ktg_json_ids_find(&r->edge_ids, &item, &seam->edges[i]));
    }
    return KTG_OK;
}

static ktg_status read_notches(const ktg_json *object, ktg_pattern_seam *seam) {
    ktg_json list, item;
    KTG_TRY(ktg_json_get_optional(object, "notches", KTG_JSON_ARRAY, &list));
    if (!list.value)
        return KTG_OK;
    size_t length = ktg_json_length(&list);
    KTG_JSON_TAKE(object, seam->notches, length, ktg_pattern_notch);
    seam->notch_count = length;
    for (size_t i = 0; i < length; i++) {
        KTG_TRY(ktg_json_item(&list, i, KTG_JSON_OBJECT, &item));
        KTG_TRY(ktg_json_number(&item, "at", &seam->notches[i].at));
        KTG_TRY(ktg_json_count(&item, "marks", KTG_JSON_MOST_COUNT, &seam->notches[i].marks));
    }
    return KTG_OK;
}

static ktg_status read_seam(const ktg_json *object, const ktg_json_reader *r, uint32_t index) {
    ktg_pattern_seam *seam = &r->pattern->seams[index];
    ktg_json sides, side, list, item;
    KTG_TRY(ktg_json_get(object, "sides", KTG_JSON_ARRAY, &sides));
    KTG_TRY(ktg_json_expect_length(&sides, 2));
    KTG_TRY(read_seam_side(&sides, 0, r, seam));
    KTG_TRY(read_seam_side(&sides, 1, r, seam));
    KTG_TRY(read_first_sides(object, r, seam));
    KTG_TRY(ktg_json_get_optional(object, "obvious", KTG_JSON_BOOLEAN, &item));
    seam->obvious = item.value && json_is_true(item.value);
    KTG_TRY(ktg_json_get_optional(object, "dart", KTG_JSON_BOOLEAN, &item));
    seam->dart = item.value && json_is_true(item.value);
    seam->number = index + 1;
    KTG_TRY(ktg_json_get_optional(object, "number", KTG_JSON_INTEGER, &item));
    if (item.value)
        KTG_TRY(ktg_json_count(object, "number", KTG_JSON_MOST_COUNT, &seam->number));
    KTG_TRY(ktg_json_get_optional(object, "closing", KTG_JSON_BOOLEAN, &item));
    seam->closing = item.value && json_is_true(item.value);
    KTG_TRY(ktg_json_get_optional(object, "section", KTG_JSON_INTEGER, &item));
    if (item.value)
        KTG_TRY(ktg_json_count(object, "section", KTG_JSON_MOST_COUNT, &seam->section));
    KTG_TRY(read_notches(object, seam));
    KTG_TRY(ktg_json_item(&sides, 0, KTG_JSON_OBJECT, &side));
    KTG_TRY(ktg_json_get(&side, "edges", KTG_JSON_ARRAY, &list));
    for (uint32_t i = 0; i < seam->edge_count; i++) {
        ktg_pattern_edge *edge = &r->pattern->edges[seam->edges[i]];
        KTG_TRY(ktg_json_item(&list, i, KTG_JSON_INTEGER, &item));
        if (edge->seam != KTG_NONE)
            return ktg_json_refuse(&item, "names an edge that seams[%u] has already", edge->seam);
        edge->seam = index;
    }
    return KTG_OK;
}

ktg_status ktg_json_read_seams(const ktg_json_reader *r) {
    ktg_pattern *p = r->pattern;
    ktg_json list, item;
    ktg_json_ids ids = {0};
    KTG_TRY(ktg_json_get(&r->root, "seams", KTG_JSON_ARRAY, &list));
    ktg_status status = ktg_json_ids_read(&list, &ids);
    ktg_json_ids_free(&ids);
    KTG_TRY(status);
    KTG_JSON_TAKE(&list, p->seams, ktg_json_length(&list), ktg_pattern_seam);
    p->seam_count = ktg_json_length(&list);
    for (size_t i = 0; i < p->seam_count; i++) {
        KTG_TRY(ktg_json_item(&list, i, KTG_JSON_OBJECT, &item));
        KTG_TRY(read_seam(&item, r, (uint32_t)i));
    }
    return KTG_OK;
}
