/* bench/nest.c - how densely polygons are nested on a strip.
 *
 *     BUILD/bench/nest [--seconds S] [--work N] [--seed N] INSTANCE.json...
 */
#include "layout/nest.h"
#include "core/clock.h"
#include "core/vec.h"
#include "pattern/pattern.h"

#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct instance {
    char name[64];
    ktg_nest_shape *shapes;
    size_t shape_count;
    uint32_t *items;
    size_t item_count;
    double width, area;
} instance;

static const struct {
    const char *name;
    double density;
} records[] = {{"albano", 89.8},  {"blaz1", 86.2},   {"dagli", 90.2},  {"fu", 92.4},
               {"jakobs1", 89.2}, {"jakobs2", 87.7}, {"mao", 86.9},    {"marques", 92.0},
               {"shapes0", 70.0}, {"shapes1", 76.7}, {"shirts", 90.9}, {"swim", 79.8},
               {"trousers", 92.6}};

static double record_of(const char *name) {
    for (size_t k = 0; k < sizeof records / sizeof *records; k++)
        if (strcmp(records[k].name, name) == 0)
            return records[k].density / 100;
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

static bool read_instance(const char *path, instance *in) {
    json_error_t error;
    json_t *root = json_load_file(path, 0, &error);
    const json_t *items = json_object_get(root, "items");
    *in = (instance){.width = json_number_value(json_object_get(root, "strip_height"))};
    if (!json_is_array(items) || !(in->width > 0)) {
        fprintf(stderr, "%s: %s\n", path, root ? "not an instance" : error.text);
        json_decref(root);
        return false;
    }
    const char *name = json_string_value(json_object_get(root, "name"));
    snprintf(in->name, sizeof in->name, "%s", name ? name : path);
    in->shape_count = json_array_size(items);
    in->shapes = checked(calloc(in->shape_count + 1, sizeof *in->shapes));
    for (size_t i = 0; i < in->shape_count; i++) {
        const json_t *item = json_array_get(items, i);
        size_t demand = (size_t)json_integer_value(json_object_get(item, "demand"));
        read_polygon(json_object_get(json_object_get(item, "shape"), "data"), &in->shapes[i]);
        read_turns(json_object_get(item, "allowed_orientations"), &in->shapes[i]);
        in->items = checked(realloc(in->items, (in->item_count + demand) * sizeof *in->items));
        for (size_t k = 0; k < demand; k++)
            in->items[in->item_count++] = (uint32_t)i;
        in->area += (double)demand * area_of(&in->shapes[i]);
    }
    json_decref(root);
    return true;
}

static ktg_status start(ktg_context *context, const instance *in, ktg_nest_place *places) {
    ktg_row_box *boxes = checked(calloc(in->item_count, sizeof *boxes));
    ktg_vec2 *lows = checked(calloc(in->item_count, sizeof *lows));
    for (size_t i = 0; i < in->item_count; i++) {
        const ktg_nest_shape *shape = &in->shapes[in->items[i]];
        double turn = shape->turn_count ? shape->turns[0] : 0;
        ktg_motion2 m = {cos(turn), sin(turn), {0, 0}};
        ktg_vec2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
        for (size_t k = 0; k < shape->outline_count; k++) {
            ktg_vec2 p = ktg_move2(m, shape->outline[k]);
            low = (ktg_vec2){fmin(low.x, p.x), fmin(low.y, p.y)};
            high = (ktg_vec2){fmax(high.x, p.x), fmax(high.y, p.y)};
        }
        lows[i] = low;
        boxes[i] = (ktg_row_box){high.y - low.y, high.x - low.x, 0, 0, 0};
        places[i].turn = turn;
    }
    uint32_t sheets;
    ktg_status status =
        ktg_rows_pack(context, in->width, INFINITY, 0, boxes, in->item_count, &sheets);
    for (size_t i = 0; i < in->item_count; i++) {
        places[i].x = boxes[i].y - lows[i].x;
        places[i].y = boxes[i].x - lows[i].y;
    }
    free(boxes);
    free(lows);
    return status;
}

int main(int argc, char **argv) {
    double seconds = 5, sum = 0, ratios = 0;
    uint64_t work = UINT64_MAX, seed = 1;
    int i = 1, count = 0, rated = 0;
    for (; i + 1 < argc && argv[i][0] == '-'; i += 2) {
        if (strcmp(argv[i], "--seconds") == 0)
            seconds = atof(argv[i + 1]);
        else if (strcmp(argv[i], "--work") == 0)
            work = strtoull(argv[i + 1], NULL, 10);
        else if (strcmp(argv[i], "--seed") == 0)
            seed = strtoull(argv[i + 1], NULL, 10);
    }
    for (; i < argc; i++) {
        instance in;
        ktg_context *context;
        if (!read_instance(argv[i], &in) || ktg_context_new(&context) != KTG_OK)
            return 1;
        ktg_context_set_seed(context, seed);
        ktg_nest_place *places = checked(calloc(in.item_count, sizeof *places));
        ktg_nest_problem problem = {in.shapes, in.shape_count, in.items, in.item_count,
                                    in.width,  INFINITY,       0,        work,
                                    seconds};
        ktg_nest_report report;
        double began = ktg_clock_seconds();
        ktg_status status = start(context, &in, places);
        if (status == KTG_OK)
            status = ktg_nest(context, &problem, places, &report);
        if (status != KTG_OK) {
            fprintf(stderr, "%s: %s\n", argv[i], ktg_context_message(context));
            return 1;
        }
        double density = in.area / (in.width * report.length), record = record_of(in.name);
        printf("%-12s %4zu items  length %10.3f  density %6.2f %%  of record %6.3f  records %5u  "
               "work %8.1f M  %6.1f s\n",
               in.name, in.item_count, report.length, 100 * density,
               record > 0 ? density / record : 0, report.records, (double)report.work / 1e6,
               ktg_clock_seconds() - began);
        fflush(stdout);
        sum += density;
        count++;
        if (record > 0) {
            ratios += density / record;
            rated++;
        }
        ktg_context_free(&context);
    }
    if (count)
        printf("mean density %.2f %%  of record %.3f\n", 100 * sum / count,
               rated ? ratios / rated : 0);
    return 0;
}
