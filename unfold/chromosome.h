/* unfold/chromosome.h - sections 5.2 and 5.3: an order of joins, and the operations on it (unfold
 * only).
 *
 * Genes are numbers 0 .. n - 1 of mergeable edges; a chromosome is a permutation of them. Once
 * decoded its accepted genes stand in front, then the rejected, then the untried ones, each in
 * their relative order. */
#ifndef KTG_UNFOLD_CHROMOSOME_H
#define KTG_UNFOLD_CHROMOSOME_H

#include "core/core.h"
#include "core/random.h"

typedef struct ktg_chromosome {
    uint32_t *genes;   /* n */
    uint32_t accepted; /* how many genes, the first ones, succeeded */
    double fitness;    /* to be minimised */
    bool decoded;      /* accepted and fitness belong to genes */
} ktg_chromosome;

/* Scratch of the crossover; each array holds n numbers. */
typedef struct ktg_crossover_scratch {
    uint8_t *success;         /* bit 0: accepted in the first parent, bit 1: in the second */
    uint32_t *first, *second; /* the reordered parents, which become the children */
    uint32_t *first_place, *second_place; /* where each gene of those stood in its parent */
    uint32_t *position;                   /* position of each gene while repairing */
} ktg_crossover_scratch;

/* A random permutation (Fisher & Yates). */
void ktg_chromosome_shuffle(ktg_chromosome *chromosome, uint32_t n, ktg_random *random);

/* Figure 6 (b): both parents are reordered so that genes accepted in both stand first and genes
 * that failed in both last; a partially mapped crossover acts on a random range of the middle; the
 * reordering is undone. *a_child and *b_child get the results. */
void ktg_chromosome_cross(const ktg_chromosome *a, const ktg_chromosome *b, uint32_t n,
                          ktg_random *random, ktg_crossover_scratch *scratch,
                          ktg_chromosome *a_child, ktg_chromosome *b_child);

/* Figure 6 (c): swaps one accepted gene with one that failed. */
void ktg_chromosome_mutate(ktg_chromosome *chromosome, uint32_t n, ktg_random *random);

#endif
