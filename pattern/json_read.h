/* pattern/json_read.h - what the files that read the JSON form share (pattern only). */
#ifndef KTG_PATTERN_JSON_READ_H
#define KTG_PATTERN_JSON_READ_H

#include "pattern/json_value.h"
#include "pattern/pattern.h"

/* Counts that are not indices into the file are below this. */
#define KTG_JSON_MOST_COUNT UINT32_MAX

typedef struct ktg_json_reader {
    ktg_pattern *pattern;
    ktg_json root, pieces, edges;
    ktg_json_ids piece_ids, edge_ids;
} ktg_json_reader;

/* Allocates `count` zeroed items; on failure the status of the calling function. */
#define KTG_JSON_TAKE(at, items, count, type)                                                      \
    do {                                                                                           \
        (items) = ktg_new((at)->context, count, type);                                             \
        if (!(items))                                                                              \
            return KTG_MEMORY;                                                                     \
    } while (0)

/* Fills pattern->pieces; their components are left open (KTG_NONE). */
KTG_NODISCARD ktg_status ktg_json_read_pieces(ktg_json_reader *reader);

/* Fills pattern->seams, and tells the edges, which are there, their seams. */
KTG_NODISCARD ktg_status ktg_json_read_seams(const ktg_json_reader *reader);

/* The id at `key` as an index. */
KTG_NODISCARD ktg_status ktg_json_read_id(const ktg_json *object, const char *key,
                                          const ktg_json_ids *ids, uint32_t *index);

#endif
