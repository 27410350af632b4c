/* bench/instance.c - reading strip-packing instances, and a simple first placement. */
#include "bench/instance.h"
#include "core/vec.h"
#include "pattern/pattern.h"

#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The densest placements known, in percent (docs/nesting.md). */
static const struct {
    const char *name;
    double percent;
} records[] = {{"albano", 89.8},  {"blaz1", 86.2},   {"dagli", 90.2},  {"fu", 92.4},
               {"jakobs1", 89.2}, {"jakobs2", 87.7}, {"mao", 86.9},    {"marques", 92.0},
               {"shapes0", 70.0}, {"shapes1", 76.7}, {"shirts", 90.9}, {"swim", 79.8},
               {"trousers", 92.6}};

static double record_of(const char *name) {
    for (size_t k = 0; k < sizeof records / sizeof *records; k++)
        if (strcmp(records[k].name, name) == 0)
            return records[k].percent / 100;
    return 0;
}

static void *checked(void *memory) {
    if (!memory) {
        fputs("out of memory\n", stderr);
        exit(1);
    }
    return memory;
}

static void read_polygon(const json_t *data, ktg_nest_shape *shape) {
    size_t count = json_array_size(data);
    ktg_vec2 *points = checked(calloc(count + 1, sizeof *points));
    for (size_t i = 0; i < count; i++) {
        const json_t *p = json_array_get(data, i);
        points[i] = (ktg_vec2){json_number_value(json_array_get(p, 0)),
                               json_number_value(json_array_get(p, 1))};
    }
    if (count > 1 && points[0].x == points[count - 1].x && points[0].y == points[count - 1].y)
        count--;
    shape->outline = shape->cover = points;
    shape->outline_count = shape->cover_count = count;
}

static void read_turns(const json_t *degrees, ktg_nest_shape *shape) {
    size_t count = json_array_size(degrees);
    double *turns = checked(calloc(count + 1, sizeof *turns));
    for (size_t i = 0; i < count; i++)
        turns[i] = json_number_value(json_array_get(degrees, i)) * KTG_PI / 180;
    shape->turns = turns;
    shape->turn_count = count;
}

static double area_of(const ktg_nest_shape *shape) {
    double twice = 0;
    for (size_t i = 0; i < shape->outline_count; i++)
        twice += ktg_cross2(shape->outline[i], shape->outline[(i + 1) % shape->outline_count]);
    return fabs(twice) / 2;
}

static bool read_item(const json_t *item, uint32_t index, bench_instance *in) {
    ktg_nest_shape *shape = &in->shapes[index];
    json_int_t demand = json_integer_value(json_object_get(item, "demand"));
    read_polygon(json_object_get(json_object_get(item, "shape"), "data"), shape);
    read_turns(json_object_get(item, "allowed_orientations"), shape);
    if (demand < 0 || demand > 100000 || shape->outline_count < 3)
        return false;
    in->items =
        checked(realloc(in->items, (in->item_count + (size_t)demand + 1) * sizeof *in->items));
    for (json_int_t k = 0; k < demand; k++)
        in->items[in->item_count++] = index;
    in->area += (double)demand * area_of(shape);
    return true;
}

static bool read_items(const json_t *items, bench_instance *in) {
    in->shape_count = json_array_size(items);
    in->shapes = checked(calloc(in->shape_count + 1, sizeof *in->shapes));
    bool good = in->shape_count > 0;
    for (size_t i = 0; good && i < in->shape_count; i++)
        good = read_item(json_array_get(items, i), (uint32_t)i, in);
    return good && in->item_count > 0;
}

bool bench_instance_read(const char *path, bench_instance *in) {
    json_error_t error = {0};
    json_t *root = json_load_file(path, 0, &error);
    *in = (bench_instance){.width = json_number_value(json_object_get(root, "strip_height"))};
    const char *name = json_string_value(json_object_get(root, "name"));
    snprintf(in->name, sizeof in->name, "%s", name ? name : path);
    in->record = record_of(in->name);
    bool good = in->width > 0 && read_items(json_object_get(root, "items"), in);
    if (!good)
        fprintf(stderr, "%s: %s\n", path, root ? "not a strip-packing instance" : error.text);
    json_decref(root);
    return good;
}

void bench_instance_drop(bench_instance *in) {
    for (size_t i = 0; in->shapes && i < in->shape_count; i++) {
        free((void *)in->shapes[i].outline);
        free((void *)in->shapes[i].turns);
    }
    free(in->shapes);
    free(in->items);
    *in = (bench_instance){0};
}

/* The box of a shape with its first turn that fits the strip, or its last one. */
static ktg_row_box box_of(const bench_instance *in, const ktg_nest_shape *shape, double *turn,
                          ktg_vec2 *low) {
    ktg_vec2 high = {0, 0};
    for (size_t t = 0; t == 0 || t < shape->turn_count; t++) {
        *turn = shape->turn_count ? shape->turns[t] : 0;
        ktg_motion2 m = {cos(*turn), sin(*turn), {0, 0}};
        *low = high = ktg_move2(m, shape->outline[0]);
        for (size_t k = 1; k < shape->outline_count; k++) {
            ktg_vec2 p = ktg_move2(m, shape->outline[k]);
            *low = (ktg_vec2){fmin(low->x, p.x), fmin(low->y, p.y)};
            high = (ktg_vec2){fmax(high.x, p.x), fmax(high.y, p.y)};
        }
        if (high.y - low->y <= in->width)
            break;
    }
    return (ktg_row_box){high.y - low->y, high.x - low->x, 0, 0, 0};
}

ktg_status bench_instance_start(ktg_context *context, const bench_instance *in,
                                ktg_nest_place *places) {
    ktg_row_box *boxes = checked(calloc(in->item_count, sizeof *boxes));
    ktg_vec2 *lows = checked(calloc(in->item_count, sizeof *lows));
    for (size_t i = 0; i < in->item_count; i++)
        boxes[i] = box_of(in, &in->shapes[in->items[i]], &places[i].turn, &lows[i]);
    uint32_t sheets;
    ktg_status status =
        ktg_rows_pack(context, in->width, INFINITY, 0, boxes, in->item_count, &sheets);
    for (size_t i = 0; i < in->item_count; i++) {
        places[i].bin = 0;
        places[i].x = boxes[i].y - lows[i].x;
        places[i].y = boxes[i].x - lows[i].y;
    }
    free(boxes);
    free(lows);
    return status;
}
