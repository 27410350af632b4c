/* unfold/genetic.c - the genetic algorithm of section 5. */
#include "unfold/genetic.h"
#include "core/memory.h"
#include "unfold/chromosome.h"
#include "unfold/fitness.h"

#include <stdio.h>
#include <string.h>

typedef struct population {
    const ktg_patches *strips;
    const ktg_unfold_options *options;
    ktg_search *search;
    ktg_patches *state; /* decoded into */
    uint32_t gene_count;
    uint32_t *gene_edge;     /* dual edge of each gene */
    uint32_t size, children; /* chromosomes kept, and made in a generation */
    ktg_chromosome *members; /* size + children; the kept ones first, best first */
    ktg_crossover_scratch scratch;
    uint32_t *rejected; /* scratch: gene_count */
    ktg_row_box *boxes; /* scratch: face_count */
} population;

/* Genes: edges not joined yet that are locally mergeable now. Others can never become it: sectors
 * only get fewer. */
static void find_genes(population *p, const bool *joined) {
    const ktg_dual *dual = p->strips->dual;
    for (uint32_t e = 0; e < dual->edge_count; e++)
        if (!joined[e] && ktg_cut_table_allows(&p->strips->table, &dual->edges[e]))
            p->gene_edge[p->gene_count++] = e;
}

static ktg_status allocate(ktg_context *context, population *p) {
    uint32_t n = p->gene_count, all = p->size + p->children;
    p->rejected = ktg_new(context, n, uint32_t);
    p->boxes = ktg_new(context, p->strips->dual->face_count, ktg_row_box);
    p->scratch.success = ktg_new(context, n, uint8_t);
    p->scratch.first = ktg_new(context, n, uint32_t);
    p->scratch.second = ktg_new(context, n, uint32_t);
    p->scratch.first_place = ktg_new(context, n, uint32_t);
    p->scratch.second_place = ktg_new(context, n, uint32_t);
    p->scratch.position = ktg_new(context, n, uint32_t);
    p->members = ktg_new(context, all, ktg_chromosome);
    if (!p->rejected || !p->boxes || !p->scratch.success || !p->scratch.first ||
        !p->scratch.second || !p->scratch.first_place || !p->scratch.second_place ||
        !p->scratch.position || !p->members)
        return KTG_MEMORY;
    for (uint32_t i = 0; i < all; i++)
        if (!(p->members[i].genes = ktg_new(context, n, uint32_t)))
            return KTG_MEMORY;
    return ktg_patches_new(context, p->strips->dual, &p->state);
}

static void population_free(population *p) {
    for (uint32_t i = 0; p->members && i < p->size + p->children; i++)
        ktg_free(p->members[i].genes);
    ktg_free(p->members);
    ktg_free(p->gene_edge);
    ktg_free(p->rejected);
    ktg_free(p->boxes);
    ktg_free(p->scratch.success);
    ktg_free(p->scratch.first);
    ktg_free(p->scratch.second);
    ktg_free(p->scratch.first_place);
    ktg_free(p->scratch.second_place);
    ktg_free(p->scratch.position);
    ktg_patches_free(&p->state);
}

/* Tries the joins in the chromosome's order until one patch is left, and reorders the genes:
 * accepted, rejected, untried (section 5.2). */
static ktg_status decode(ktg_context *context, population *p, ktg_chromosome *chromosome) {
    if (chromosome->decoded)
        return KTG_OK;
    KTG_TRY(ktg_patches_assign(context, p->state, p->strips));
    uint32_t accepted = 0, rejected = 0, i = 0;
    for (; i < p->gene_count && p->state->patch_count > 1; i++) {
        uint32_t gene = chromosome->genes[i];
        ktg_join result;
        KTG_TRY(ktg_patches_join(context, p->state, p->gene_edge[gene], &result));
        if (result == KTG_JOINED)
            chromosome->genes[accepted++] = gene;
        else
            p->rejected[rejected++] = gene;
    }
    if (rejected > 0)
        memcpy(chromosome->genes + accepted, p->rejected, rejected * sizeof *p->rejected);
    chromosome->accepted = accepted;
    chromosome->decoded = true;
    p->search->report.evaluations++;
    return ktg_fitness(context, p->state, p->boxes, &chromosome->fitness);
}

/* Best first; equal ones keep their order, so that every run is the same. */
static void sort_members(population *p, uint32_t count) {
    for (uint32_t i = 1; i < count; i++) {
        ktg_chromosome member = p->members[i];
        uint32_t j = i;
        for (; j > 0 && p->members[j - 1].fitness > member.fitness; j--)
            p->members[j] = p->members[j - 1];
        p->members[j] = member;
    }
}

/* Binary tournament. */
static const ktg_chromosome *choose_parent(population *p) {
    const ktg_chromosome *a = &p->members[ktg_random_below(&p->search->random, p->size)];
    const ktg_chromosome *b = &p->members[ktg_random_below(&p->search->random, p->size)];
    return b->fitness < a->fitness ? b : a;
}

static void copy_parent(const population *p, const ktg_chromosome *from, ktg_chromosome *to) {
    uint32_t *genes = to->genes;
    *to = *from;
    to->genes = genes;
    memcpy(genes, from->genes, p->gene_count * sizeof *genes);
}

static void make_pair(population *p, ktg_chromosome *first, ktg_chromosome *second) {
    ktg_random *random = &p->search->random;
    const ktg_chromosome *a = choose_parent(p), *b = choose_parent(p);
    if (ktg_random_unit(random) < p->options->crossover_rate) {
        ktg_chromosome_cross(a, b, p->gene_count, random, &p->scratch, first, second);
    } else {
        copy_parent(p, a, first);
        copy_parent(p, b, second);
    }
    if (ktg_random_unit(random) < p->options->mutation_rate)
        ktg_chromosome_mutate(first, p->gene_count, random);
    if (ktg_random_unit(random) < p->options->mutation_rate)
        ktg_chromosome_mutate(second, p->gene_count, random);
}

/* Children replace the worse half, whatever they are worth: they stand behind the better half, then
 * all are sorted. */
static ktg_status next_generation(ktg_context *context, population *p) {
    ktg_chromosome *children = p->members + p->size;
    for (uint32_t i = 0; i + 1 < p->children; i += 2)
        make_pair(p, &children[i], &children[i + 1]);
    for (uint32_t i = 0; i < p->children; i++) {
        KTG_TRY(decode(context, p, &children[i]));
        ktg_chromosome *worse = &p->members[p->size - p->children + i], child = children[i];
        children[i] = *worse;
        *worse = child;
        if (!ktg_search_goes_on(context, p->search))
            break;
    }
    sort_members(p, p->size);
    return KTG_OK;
}

static void tell_progress(ktg_context *context, const population *p, uint32_t generation) {
    ktg_search *search = p->search;
    const ktg_chromosome *best = &p->members[0];
    char detail[80];
    uint32_t pieces = p->strips->patch_count - best->accepted;
    double all = (double)search->report.generations + generation - search->generations_before;
    double own = all / (all + 100) * p->strips->dual->face_count; /* goes on through restarts */
    snprintf(detail, sizeof detail, "generation %u, %u piece%s", generation, pieces,
             pieces == 1 ? "" : "s");
    ktg_search_progress(context, search, own, detail);
}

static ktg_status first_generation(ktg_context *context, population *p) {
    uint32_t ready = 0;
    for (uint32_t i = 0; i < p->size; i++)
        ktg_chromosome_shuffle(&p->members[i], p->gene_count, &p->search->random);
    do
        KTG_TRY(decode(context, p, &p->members[ready++]));
    while (ready < p->size && ktg_search_goes_on(context, p->search));
    sort_members(p, ready);
    return KTG_OK;
}

static ktg_status evolve(ktg_context *context, population *p) {
    KTG_TRY(first_generation(context, p));
    uint32_t generation = 0, idle = 0;
    while (idle < p->options->patience && ktg_search_goes_on(context, p->search)) {
        if (generation == p->options->generations) {
            p->search->report.stopped_by = KTG_STOPPED_WORK;
            break;
        }
        double before = p->members[0].fitness;
        KTG_TRY(next_generation(context, p));
        generation++;
        idle = p->members[0].fitness < before ? 0 : idle + 1;
        tell_progress(context, p, generation);
    }
    p->search->report.generations += generation;
    return KTG_OK;
}

ktg_status ktg_genetic_merge(ktg_context *context, const ktg_patches *strips,
                             const ktg_unfold_options *options, ktg_search *search, bool *joined,
                             uint32_t *pieces) {
    population p = {.strips = strips,
                    .options = options,
                    .search = search,
                    .size = options->population,
                    .children = options->population / 4 * 2};
    p.gene_edge = ktg_new(context, strips->dual->edge_count, uint32_t);
    if (!p.gene_edge)
        return KTG_MEMORY;
    find_genes(&p, joined);
    ktg_status status = KTG_OK;
    *pieces = strips->patch_count;
    if (strips->patch_count > 1 && p.gene_count > 0) {
        status = allocate(context, &p);
        if (status == KTG_OK)
            status = evolve(context, &p);
        for (uint32_t i = 0; status == KTG_OK && i < p.members[0].accepted; i++)
            joined[p.gene_edge[p.members[0].genes[i]]] = true;
        if (status == KTG_OK)
            *pieces -= p.members[0].accepted;
    }
    population_free(&p);
    return status;
}
