/* mesh/boxes.c - a bounding box tree in one array: node i has the children 2 i and 2 i + 1.
 *
 * Items are halved at the median of the longest axis of their centres. A changed item keeps its
 * place and the boxes above it are refitted; whoever changes much builds anew from time to time. */
#include "mesh/boxes.h"
#include "core/memory.h"

#include <math.h>
#include <string.h>

struct ktg_boxes {
    uint32_t leaves;     /* a power of two; leaf i is node leaves + i */
    ktg_box *nodes;      /* 2 leaves; node 0 is not used */
    uint32_t *leaf_of;   /* item_limit: the leaf of each item */
    uint32_t *leaf_item; /* leaves: its item, or KTG_NONE */
};

typedef struct builder {
    ktg_boxes *tree;
    const ktg_box *boxes;
    const uint32_t *items;
    uint32_t *order;
} builder;

static const ktg_box no_box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

/* Halves first: the sum of two coordinates might overflow. */
static double centre(const ktg_box *box, int axis) {
    switch (axis) {
    case 0:
        return box->low.x / 2 + box->high.x / 2;
    case 1:
        return box->low.y / 2 + box->high.y / 2;
    default:
        return box->low.z / 2 + box->high.z / 2;
    }
}

static int longest_axis(const builder *b, uint32_t begin, uint32_t end) {
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t i = begin; i < end; i++)
        for (int axis = 0; axis < 3; axis++) {
            double c = centre(&b->boxes[b->order[i]], axis);
            low[axis] = fmin(low[axis], c);
            high[axis] = fmax(high[axis], c);
        }
    int longest = 0;
    for (int axis = 1; axis < 3; axis++)
        if (high[axis] - low[axis] > high[longest] - low[longest])
            longest = axis;
    return longest;
}

/* Hoare's selection: afterwards the `middle - begin` items of the lowest centres come first. Ties
 * go by number, so that the order is the same everywhere. */
static void select_median(builder *b, uint32_t begin, uint32_t end, uint32_t middle, int axis) {
    uint32_t *order = b->order;
    int64_t low = begin, high = (int64_t)end - 1;
    while (low < high) {
        uint32_t pivot = order[low + (high - low) / 2];
        double value = centre(&b->boxes[pivot], axis);
        int64_t i = low, j = high;
        while (i <= j) {
            double c;
            while ((c = centre(&b->boxes[order[i]], axis)) < value ||
                   (c == value && order[i] < pivot))
                i++;
            while ((c = centre(&b->boxes[order[j]], axis)) > value ||
                   (c == value && order[j] > pivot))
                j--;
            if (i <= j) {
                uint32_t swap = order[i];
                order[i++] = order[j];
                order[j--] = swap;
            }
        }
        if ((int64_t)middle <= j)
            high = j;
        else if ((int64_t)middle >= i)
            low = i;
        else
            return;
    }
}

/* Places items begin .. end - 1 of the order under `node`, which has `leaves` leaves from `leaf`
 * on. */
static void place(builder *b, uint32_t node, uint32_t leaf, uint32_t leaves, uint32_t begin,
                  uint32_t end) {
    ktg_boxes *tree = b->tree;
    if (begin == end)
        return;
    if (leaves == 1) {
        uint32_t box = b->order[begin], item = b->items ? b->items[box] : box;
        tree->nodes[node] = b->boxes[box];
        tree->leaf_of[item] = leaf;
        tree->leaf_item[leaf] = item;
        return;
    }
    uint32_t middle = begin + (end - begin + 1) / 2;
    if (end - begin > 1)
        select_median(b, begin, end, middle, longest_axis(b, begin, end));
    place(b, 2 * node, leaf, leaves / 2, begin, middle);
    place(b, 2 * node + 1, leaf + leaves / 2, leaves / 2, middle, end);
    tree->nodes[node] = ktg_box_join(tree->nodes[2 * node], tree->nodes[2 * node + 1]);
}

ktg_status ktg_boxes_new(ktg_context *context, const ktg_box *boxes, const uint32_t *items,
                         uint32_t count, uint32_t item_limit, ktg_boxes **tree) {
    *tree = ktg_new(context, 1, ktg_boxes);
    if (!*tree)
        return KTG_MEMORY;
    ktg_boxes *t = *tree;
    t->leaves = 1;
    while (t->leaves < count)
        t->leaves *= 2;
    t->nodes = ktg_new(context, 2 * (size_t)t->leaves, ktg_box);
    t->leaf_of = ktg_new(context, item_limit, uint32_t);
    t->leaf_item = ktg_new(context, t->leaves, uint32_t);
    uint32_t *order = ktg_new(context, count, uint32_t);
    if (!t->nodes || !t->leaf_of || !t->leaf_item || !order) {
        ktg_free(order);
        ktg_boxes_free(tree);
        return KTG_MEMORY;
    }
    for (uint32_t i = 0; i < 2 * t->leaves; i++)
        t->nodes[i] = no_box;
    memset(t->leaf_item, 0xff, t->leaves * sizeof *t->leaf_item);
    for (uint32_t i = 0; i < count; i++)
        order[i] = i;
    builder b = {t, boxes, items, order};
    place(&b, 1, 0, t->leaves, 0, count);
    ktg_free(order);
    return KTG_OK;
}

void ktg_boxes_free(ktg_boxes **tree) {
    if (!tree || !*tree)
        return;
    ktg_free((*tree)->nodes);
    ktg_free((*tree)->leaf_of);
    ktg_free((*tree)->leaf_item);
    ktg_free(*tree);
    *tree = NULL;
}

void ktg_boxes_set(ktg_boxes *tree, uint32_t item, ktg_box box) {
    uint32_t node = tree->leaves + tree->leaf_of[item];
    tree->nodes[node] = box;
    for (node /= 2; node > 0; node /= 2) {
        ktg_box joined = ktg_box_join(tree->nodes[2 * node], tree->nodes[2 * node + 1]);
        if (memcmp(&joined, &tree->nodes[node], sizeof joined) == 0)
            break;
        tree->nodes[node] = joined;
    }
}

void ktg_boxes_remove(ktg_boxes *tree, uint32_t item) {
    ktg_boxes_set(tree, item, no_box);
}

ktg_status ktg_boxes_query(ktg_context *context, const ktg_boxes *tree, ktg_box box, size_t most,
                           uint32_t **found, size_t *capacity, size_t *count) {
    uint32_t stack[64], depth = 0; /* one waits per level, and there are at most 33 levels */
    *count = 0;
    stack[depth++] = 1;
    while (depth > 0 && *count < most) {
        uint32_t node = stack[--depth];
        if (!ktg_box_meets(tree->nodes[node], box))
            continue;
        if (node < tree->leaves) {
            stack[depth++] = 2 * node + 1;
            stack[depth++] = 2 * node;
        } else if (tree->leaf_item[node - tree->leaves] != KTG_NONE) {
            KTG_TRY(ktg_reserve(context, found, capacity, *count + 1));
            (*found)[(*count)++] = tree->leaf_item[node - tree->leaves];
        }
    }
    return KTG_OK;
}
