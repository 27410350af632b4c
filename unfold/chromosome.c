/* unfold/chromosome.c - crossover and mutation (section 5.3, figure 6 of the paper). */
#include "unfold/chromosome.h"

#include <string.h>

void ktg_chromosome_shuffle(ktg_chromosome *chromosome, uint32_t n, ktg_random *random) {
    for (uint32_t i = 0; i < n; i++)
        chromosome->genes[i] = i;
    for (uint32_t i = n; i > 1; i--) {
        size_t j = ktg_random_below(random, i);
        uint32_t gene = chromosome->genes[i - 1];
        chromosome->genes[i - 1] = chromosome->genes[j];
        chromosome->genes[j] = gene;
    }
    chromosome->decoded = false;
}

/* p1 -> p2 in the paper's figure: common successes first, common failures last, the rest between,
 * each keeping its order. Returns where the middle begins and ends; place[i] is where gene i of the
 * new order stood. */
static void reorder(const ktg_chromosome *parent, uint32_t n, const uint8_t *success,
                    uint32_t *order, uint32_t *place, uint32_t *begin, uint32_t *end) {
    uint32_t count = 0;
    static const uint8_t both = 3, neither = 0;
    for (uint32_t i = 0; i < n; i++)
        if (success[parent->genes[i]] == both)
            place[count++] = i;
    *begin = count;
    for (uint32_t i = 0; i < n; i++)
        if (success[parent->genes[i]] != both && success[parent->genes[i]] != neither)
            place[count++] = i;
    *end = count;
    for (uint32_t i = 0; i < n; i++)
        if (success[parent->genes[i]] == neither)
            place[count++] = i;
    for (uint32_t i = 0; i < n; i++)
        order[i] = parent->genes[place[i]];
}

/* Gene by gene: brings wanted[k] to place k of `order` by a swap, so that every gene stands once.
 */
static void map_range(uint32_t *order, const uint32_t *wanted, uint32_t from, uint32_t to,
                      uint32_t n, uint32_t *position) {
    for (uint32_t i = 0; i < n; i++)
        position[order[i]] = i;
    for (uint32_t k = from; k < to; k++) {
        uint32_t here = order[k], there = position[wanted[k - from]];
        order[there] = here;
        position[here] = there;
        order[k] = wanted[k - from];
        position[order[k]] = k;
    }
}

static void undo_order(const uint32_t *order, const uint32_t *place, uint32_t n,
                       ktg_chromosome *child) {
    for (uint32_t i = 0; i < n; i++)
        child->genes[place[i]] = order[i];
    child->decoded = false;
}

static void copy(const ktg_chromosome *from, uint32_t n, ktg_chromosome *to) {
    memcpy(to->genes, from->genes, n * sizeof *to->genes);
    to->accepted = from->accepted;
    to->fitness = from->fitness;
    to->decoded = from->decoded;
}

void ktg_chromosome_cross(const ktg_chromosome *a, const ktg_chromosome *b, uint32_t n,
                          ktg_random *random, ktg_crossover_scratch *s, ktg_chromosome *a_child,
                          ktg_chromosome *b_child) {
    uint32_t begin, end;
    memset(s->success, 0, n);
    for (uint32_t i = 0; i < a->accepted; i++)
        s->success[a->genes[i]] |= 1;
    for (uint32_t i = 0; i < b->accepted; i++)
        s->success[b->genes[i]] |= 2;
    reorder(a, n, s->success, s->first, s->first_place, &begin, &end);
    reorder(b, n, s->success, s->second, s->second_place, &begin, &end);
    copy(a, n, a_child);
    copy(b, n, b_child);
    if (end - begin < 2)
        return;
    uint32_t from = begin + (uint32_t)ktg_random_below(random, end - begin);
    uint32_t to = begin + (uint32_t)ktg_random_below(random, end - begin);
    if (from > to) {
        uint32_t other = from;
        from = to;
        to = other;
    }
    to++;
    /* the children's own arrays hold what the other parent has in the range */
    memcpy(a_child->genes, s->second + from, (to - from) * sizeof(uint32_t));
    memcpy(b_child->genes, s->first + from, (to - from) * sizeof(uint32_t));
    map_range(s->first, a_child->genes, from, to, n, s->position);
    map_range(s->second, b_child->genes, from, to, n, s->position);
    undo_order(s->first, s->first_place, n, a_child);
    undo_order(s->second, s->second_place, n, b_child);
}

void ktg_chromosome_mutate(ktg_chromosome *chromosome, uint32_t n, ktg_random *random) {
    uint32_t accepted = chromosome->accepted;
    if (accepted == 0 || accepted >= n)
        return;
    size_t i = ktg_random_below(random, accepted);
    size_t j = accepted + ktg_random_below(random, n - accepted);
    uint32_t gene = chromosome->genes[i];
    chromosome->genes[i] = chromosome->genes[j];
    chromosome->genes[j] = gene;
    chromosome->decoded = false;
}
