/* unfold/arrange.c - annealing pieces without overlaps towards their sheets. */
#include "unfold/arrange.h"
#include "core/memory.h"

#include "unfold/net.h"
#include "unfold/seam_tabs.h"
#include "unfold/transplant.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct anneal {
    ktg_arrangement *a;
    ktg_search *search;
    double *area, *cost;
    double total, temperature, threshold;
    ktg_vec2 per;
    int power; ktg_seam_tabs *tabs; ktg_saved saved; double lambda; uint64_t tabtried, tabacc;
    uint32_t *degree, *chain; double *deficit; bool *border; float *dead; ktg_seam_tab_wish wish; double leaf;
    uint64_t work; double mu; uint32_t conflicts;
    uint64_t tried, passed, accepted;
} anneal;

static double P(const char *n, double d) { const char *s = getenv(n); return s ? atof(s) : d; }

static double raised(double x, int power) {
    double x2 = x * x;
    double x4 = x2 * x2;
    if (power == 2) return x2;
    if (power == 4) return x4;
    if (power == 6) return x4 * x2;
    if (power == 8) return x4 * x4;
    if (power == 12) return x4 * x4 * x4;
    x4 *= x4;
    return x4 * x4;
}

static double cost_at(const anneal *s, uint32_t face, ktg_vec2 middle) {
    return s->area[face] * (raised(middle.x * s->per.x, s->power) + raised(middle.y * s->per.y, s->power));
}

static ktg_vec2 middle_of(const ktg_arrangement *a, uint32_t face) {
    const ktg_vec2 *p = a->corners + 3 * (size_t)face;
    return (ktg_vec2){(p[0].x + p[1].x + p[2].x) / 3, (p[0].y + p[1].y + p[2].y) / 3};
}

static bool draw_graft(anneal *s, ktg_branch *branch, ktg_graft *graft) {
    const ktg_arrangement *a = s->a;
    ktg_random *random = &s->search->random;
    uint32_t face = (uint32_t)ktg_random_below(random, a->dual->face_count);
    uint32_t fold = a->parent_edge[face];
    if (fold == KTG_NONE || a->dual->edges[fold].rigid)
        return false;
    *branch = ktg_branch_at(a, face);
    for (int tries = 0; tries < 4; tries++) {
        uint32_t f = a->order[branch->first + ktg_random_below(random, branch->count)];
        uint32_t own = 3 * f + (uint32_t)ktg_random_below(random, 3);
        uint32_t e = a->dual->halfedge_edge[own];
        if (e == KTG_NONE || a->folded[e])
            continue;
        uint32_t other = ktg_arrangement_across(a, e, own);
        if (ktg_branch_holds(a, branch, other / 3))
            continue;
        *graft = (ktg_graft){.edge = e, .own = own, .other = other};
        return true;
    }
    return false;
}

static bool spread_allows(anneal *s, const ktg_branch *b, const ktg_graft *g, double allowed, double *change) {
    const ktg_arrangement *a = s->a;
    double before = 0, after = 0;
    for (uint32_t i = 0; i < b->count; i++)
        before += s->cost[a->order[b->first + i]];
    double most = before + allowed;
    for (uint32_t i = 0; i < b->count; i++) {
        uint32_t face = a->order[b->first + i];
        after += cost_at(s, face, ktg_move2(g->motion, middle_of(a, face)));
        if (after > most) { s->work += i; return false; }
    }
    s->work += b->count;
    *change = after - before;
    return true;
}

/* leaves */
static double leaf_price(const anneal *s, uint32_t v) {
    if (s->degree[v] != 1 || s->border[v]) return 0;
    uint32_t e = s->chain[v];
    double length = s->a->dual->edges[e].length;
    if (length < s->wish.edge) return 0;
    double room = length * s->deficit[v] / (P("NEED", 1.3) * s->wish.least);
    return room < 1 ? 1 - room : 0;
}
static double price4(const anneal *s, const uint32_t *p, const uint32_t *q) {
    double sum = leaf_price(s, p[0]) + leaf_price(s, p[1]);
    for (int i = 0; i < 2; i++) if (q[i] != p[0] && q[i] != p[1]) sum += leaf_price(s, q[i]);
    return sum;
}
static void toggle(anneal *s, uint32_t e, uint32_t change) {
    for (int i = 0; i < 2; i++) { uint32_t v = s->a->dual->edges[e].vertices[i]; s->degree[v] += change; s->chain[v] ^= e; }
}
static double leaf_change(anneal *s, uint32_t cut, uint32_t join) {
    const uint32_t *p = s->a->dual->edges[cut].vertices, *q = s->a->dual->edges[join].vertices;
    double before = price4(s, p, q);
    toggle(s, cut, 1); toggle(s, join, -1u);
    double after = price4(s, p, q);
    return after - before + s->dead[cut] - s->dead[join];
}

static ktg_status try_move(ktg_context *context, anneal *s) {
    ktg_branch b;
    ktg_graft g;
    double change;
    s->work += 4;
    s->tried++;
    if (!draw_graft(s, &b, &g)) return KTG_OK;
    ktg_graft_motion(s->a, &g);
    double allowed = -s->temperature * log(1 - ktg_random_unit(&s->search->random));
    double gain = s->tabs ? s->lambda * s->tabs->tabs[g.edge].price : 0;
    uint32_t fold = s->a->parent_edge[b.top];
    bool leaves = s->mu > 0 && s->degree;
    if (leaves) { gain = -s->lambda * leaf_change(s, fold, g.edge); toggle(s, fold, -1u); toggle(s, g.edge, 1); }
    double gain0 = gain; allowed += s->mu > 0 ? gain : 0; gain = s->mu > 0 ? 0 : gain;
    if (!spread_allows(s, &b, &g, allowed + gain, &change)) return KTG_OK;
    s->passed++;
    if (s->mu == 0) {
        if (ktg_graft_conflicts(s->a, &b, &g, 0) > 0) return KTG_OK;
    } else {
        uint32_t spare = (uint32_t)fmin(1e6, (allowed - change) / s->mu);
        uint32_t most = s->conflicts + spare;
        uint32_t after = ktg_graft_conflicts(s->a, &b, &g, most);
        if (after > most) return KTG_OK;
        uint32_t before = s->conflicts > 0 ? ktg_graft_conflicts(s->a, &b, NULL, 1000000) : 0;
        if (after > before + spare) return KTG_OK;
        s->conflicts += after - before;
        if (leaves) { toggle(s, fold, 1); toggle(s, g.edge, -1u); s->leaf -= gain0; }
    }
    if (s->tabs) {
        double price = s->tabs->price;
        s->tabtried++;
        s->work += 10;
        ktg_seam_tabs_begin(s->tabs);
        KTG_TRY(ktg_seam_tabs_damage(context, s->tabs, &b, &g));
        ktg_branch_save(s->a, &b, &s->saved);
        KTG_TRY(ktg_arrangement_graft(context, s->a, &b, &g));
        KTG_TRY(ktg_seam_tabs_follow(context, s->tabs, &b, g.edge, s->saved.fold));
        if (change + s->lambda * (s->tabs->price - price) > allowed) {
            KTG_TRY(ktg_arrangement_ungraft(context, s->a, &b, &s->saved));
            KTG_TRY(ktg_seam_tabs_lay(context, s->tabs, &b));
            return ktg_seam_tabs_undo(context, s->tabs);
        }
    } else
    KTG_TRY(ktg_arrangement_graft(context, s->a, &b, &g));
    s->accepted++;
    for (uint32_t i = 0; i < b.count; i++) {
        uint32_t face = s->a->order[b.first + i];
        s->cost[face] = cost_at(s, face, middle_of(s->a, face));
    }
    s->total += change;
    return KTG_OK;
}

static ktg_status try_tab(ktg_context *context, anneal *s) {
    static const double parts[] = {1, 0.7, 0.4};
    ktg_seam_tabs *t = s->tabs;
    ktg_random *random = &s->search->random;
    if (t->unhappy_count == 0) return KTG_OK;
    uint32_t e = t->unhappy[ktg_random_below(random, t->unhappy_count)];
    double price = t->price, allowed = -s->temperature * log(1 - ktg_random_unit(random));
    s->work += 10;
    ktg_seam_tabs_begin(t);
    size_t mode = ktg_random_below(random, 4);
    if (mode == 0) KTG_TRY(ktg_seam_tabs_choose(context, t, e));
    else KTG_TRY(ktg_seam_tabs_push(context, t, e, (int)ktg_random_below(random, 2), parts[mode - 1]));
    if (s->lambda * (t->price - price) > allowed) return ktg_seam_tabs_undo(context, t);
    return KTG_OK;
}

static void recost(anneal *s) {
    s->total = 0;
    for (uint32_t f = 0; f < s->a->dual->face_count; f++)
        s->total += s->cost[f] = cost_at(s, f, middle_of(s->a, f));
}

static ktg_status run_soft(ktg_context *context, anneal *s, uint64_t most_work) {
    double n = s->a->dual->face_count;
    double hot = P("SHOT", 20) / n, cold = P("SCOLD", 0.5) / n;
    s->power = 4; recost(s);
    for (uint64_t i = 0; s->work < most_work; i++) {
        if (i % 256 == 0) {
            double done = (double)s->work / (double)most_work;
            s->temperature = hot * pow(cold / hot, done);
            s->mu = s->temperature * (P("MU0",0.5) + (P("MU1",5) - P("MU0",0.5)) * done);
            if (!ktg_search_goes_on(context, s->search)) break;
        }
        if (i % 65536 == 65535) {
            ktg_arrangement_order(s->a);
            KTG_TRY(ktg_arrangement_settle(context, s->a));
            recost(s);
        }
        KTG_TRY(try_move(context, s));
    }
    fprintf(stderr, "soft: tried %g passed %g accepted %g total %g conflicts %u\n", (double)s->tried, (double)s->passed, (double)s->accepted, s->total, s->conflicts);
    s->work = s->tried = s->passed = s->accepted = 0; s->mu = 0;
    return KTG_OK;
}

static ktg_status run(ktg_context *context, anneal *s, uint64_t most_work) {
    double n = s->a->dual->face_count;
    double hot = P("HOT", 2) / n, cold = P("COLD", 0.02) / n;
    for (uint64_t i = 0; s->work < most_work; i++) {
        if (i % 256 == 0) {
            double done = (double)s->work / (double)most_work;
            s->temperature = hot * pow(cold / hot, done);
            int power = done < P("S1", 2) ? (int)P("POW",4) : done < P("S2", 2) ? (int)P("POW2",8) : 16;
            if (power != s->power) { s->power = power; recost(s); }
            if (!ktg_search_goes_on(context, s->search)) break;
        }
        if (i % 65536 == 65535) {
            ktg_arrangement_order(s->a);
            KTG_TRY(ktg_arrangement_settle(context, s->a));
            recost(s);
            if (s->tabs) { ktg_branch all = {0, 0, (uint32_t)n}; KTG_TRY(ktg_seam_tabs_lay(context, s->tabs, &all)); }
        }
        if (s->tabs && i % 8 == 0) KTG_TRY(try_tab(context, s)); else
        KTG_TRY(try_move(context, s));
    }
    if (s->tabs) { int none = 0, red = 0, full = 0; for (uint32_t e = 0; e < s->a->dual->edge_count; e++) { double p = s->tabs->tabs[e].price; if (p >= 1) none++; else if (p > 0) red++; else if (!s->a->folded[e]) full++; }
      int un = 0, unall = 0, oneun = 0; for (uint32_t e = 0; e < s->a->dual->edge_count; e++) { const uint32_t *h = s->a->dual->edges[e].halfedge; bool dead = !s->tabs->slots[h[0]].usable && !s->tabs->slots[h[1]].usable && s->a->dual->edges[e].length >= s->tabs->wish.edge; unall += dead; if (s->tabs->tabs[e].price >= 1) { un += dead; oneun += !s->tabs->slots[h[0]].usable != !s->tabs->slots[h[1]].usable; 
        double la = s->a->dual->edges[e].length / s->tabs->wish.least * 2;
        ktg_trapezoid sh; ktg_vec2 o[2]; double op[2]; for (int k = 0; k < 2; k++) { const ktg_arrangement *a = s->a; uint32_t hh = h[k], hn = hh % 3 == 2 ? hh - 2 : hh + 1; o[k] = ktg_sub2(a->corners[hn], a->corners[hh]); (void)op; (void)sh; }
        double ang = atan2(ktg_cross2(o[0], ktg_mul2(o[1], -1)), ktg_dot2(o[0], ktg_mul2(o[1], -1))) * 57.3;
        fprintf(stderr, "  none: len %.1f mm dead %d usable %d %d angle %.1f gap %.1f mm\n", la, dead, s->tabs->slots[h[0]].usable, s->tabs->slots[h[1]].usable, ang, ktg_length2(ktg_sub2(ktg_mul2(ktg_add2(s->a->corners[h[0]], s->a->corners[h[0] % 3 == 2 ? h[0] - 2 : h[0] + 1]), .5), ktg_mul2(ktg_add2(s->a->corners[h[1]], s->a->corners[h[1] % 3 == 2 ? h[1] - 2 : h[1] + 1]), .5))) / s->tabs->wish.least * 2); } }
      fprintf(stderr, "dead %d of them none %d, one side dead none %d\n", unall, un, oneun);
      fprintf(stderr, "tabs price %g none %d reduced %d full(or short) %d tried %g\n", s->tabs->price, none, red, full, (double)s->tabtried); }
    fprintf(stderr, "tried %g passed %g accepted %g total %g work %g\n", (double)s->tried, (double)s->passed, (double)s->accepted, s->total, (double)s->work);
    return KTG_OK;
}

ktg_status ktg_arrange_run(ktg_context *context, const ktg_dual *dual, bool *folded, double aspect, uint64_t work, ktg_search *search) {
    size_t n = dual->face_count;
    anneal s = {.search = search, .power = (int)P("POW", 4)};
    double all = 0;
    s.area = ktg_new(context, n, double);
    s.cost = ktg_new(context, n, double);
    for (uint32_t f = 0; f < n; f++) {
        const ktg_vec2 *p = dual->flat + 3 * (size_t)f;
        s.area[f] = 0.5 * ktg_cross2(ktg_sub2(p[1], p[0]), ktg_sub2(p[2], p[0]));
        all += s.area[f];
    }
    double fill = P("FILL", 0.6);
    ktg_vec2 half = {0.5 * sqrt(all / fill * aspect), 0.5 * sqrt(all / fill / aspect)};
    s.per = (ktg_vec2){1 / half.x, 1 / half.y};
    for (uint32_t f = 0; f < n; f++) s.area[f] /= all;
    ktg_status status = ktg_arrangement_new(context, dual, folded, ktg_mul2(half, 1.4), (uint32_t)n + dual->edge_count, &s.a);
    if (status == KTG_OK) {
        recost(&s);
        double mm = sqrt(P("TFILL", 0.42) * 190 * 277 / all);
        s.lambda = P("SLAM", 2) / (double)n;
        s.wish = (ktg_seam_tab_wish){5 / mm, 2 / mm, 4 / mm, 0.3 / mm, 0.15 / mm, 1 / tan(50 * KTG_PI / 180)};
        if (P("TABS", 0) > 0 && P("SLAM", 2) > 0) {
            uint32_t nv = dual->vertex_count;
            s.degree = ktg_new(context, nv, uint32_t); s.chain = ktg_new(context, nv, uint32_t); s.deficit = ktg_new(context, nv, double); s.border = ktg_new(context, nv, bool); s.dead = ktg_new(context, dual->edge_count, float);
            for (uint32_t v = 0; v < nv; v++) s.deficit[v] = 2 * KTG_PI;
            for (uint32_t h = 0; h < 3 * n; h++) {
                uint32_t prev = h % 3 == 0 ? h + 2 : h - 1;
                ktg_vec2 u = dual->flat_vectors[h], w = ktg_mul2(dual->flat_vectors[prev], -1);
                s.deficit[dual->faces[h]] -= fabs(atan2(ktg_cross2(u, w), ktg_dot2(u, w)));
                if (dual->halfedge_edge[h] == KTG_NONE) s.border[dual->faces[h]] = s.border[dual->faces[h % 3 == 2 ? h - 2 : h + 1]] = true;
            }
            status = ktg_seam_tabs_new(context, s.a, &s.wish, &s.tabs);
            for (uint32_t e = 0; e < dual->edge_count; e++) { const uint32_t *h = dual->edges[e].halfedge; s.dead[e] = dual->edges[e].length < s.wish.edge ? 0 : !s.tabs->slots[h[0]].usable && !s.tabs->slots[h[1]].usable ? 1 : s.tabs->slots[h[0]].usable && s.tabs->slots[h[1]].usable ? 0 : 0.2; }
            ktg_seam_tabs_free(&s.tabs);
            for (uint32_t e = 0; e < dual->edge_count; e++) ktg_cells_take_out(&s.a->cells, n + e);
            for (uint32_t e = 0; e < dual->edge_count; e++) if (!s.a->folded[e]) toggle(&s, e, 1);
            double sum = 0; for (uint32_t v = 0; v < nv; v++) sum += leaf_price(&s, v);
            double dd = 0; for (uint32_t e = 0; e < dual->edge_count; e++) if (!s.a->folded[e]) dd += s.dead[e];
            fprintf(stderr, "leaf price %g dead %g\n", sum, dd);
        }
        double soft = P("SOFT", 0);
        if (soft > 0) {
            status = run_soft(context, &s, (uint64_t)(work * soft));
            for (uint32_t e = 0; e < dual->edge_count; e++) folded[e] = s.a->folded[e];
            if (s.conflicts > 0) {
            uint32_t root = s.a->order[0];
            ktg_vec2 c0 = s.a->corners[3*root], c1 = s.a->corners[3*root+1];
            ktg_net *net = NULL;
            status = ktg_net_new(context, dual, folded, &net);
            if (status == KTG_OK) status = ktg_transplant_run(context, net, 20000, search);
            for (uint32_t e = 0; e < dual->edge_count; e++) folded[e] = net->folded[e];
            fprintf(stderr, "left %zu\n", net->live_count);
            ktg_net_free(&net);
            ktg_arrangement_free(&s.a);
            status = ktg_arrangement_new(context, dual, folded, ktg_mul2(half, 1.4), (uint32_t)n + dual->edge_count, &s.a);
            status = ktg_arrangement_move(context, s.a, 0, ktg_motion2_between(s.a->corners[3*root], s.a->corners[3*root+1], c0, c1));
            recost(&s);
            }
            if (s.degree) { double sum = 0; for (uint32_t v = 0; v < dual->vertex_count; v++) sum += leaf_price(&s, v);
            double dd = 0; for (uint32_t e = 0; e < dual->edge_count; e++) if (!s.a->folded[e]) dd += s.dead[e];
            fprintf(stderr, "leaf price %g dead %g\n", sum, dd); }
            fprintf(stderr, "total %g\n", s.total);
        }
        if (P("TABS", 0) > 0) {
            double mm = sqrt(P("TFILL", 0.42) * 190 * 277 / all);
            s.lambda = P("LAM", 2) / (double)n;
            ktg_seam_tab_wish w = {5 / mm, 2 / mm, 4 / mm, 0.3 / mm, 0.15 / mm, 1 / tan(50 * KTG_PI / 180)};
            s.saved = (ktg_saved){.faces = ktg_new(context, n, uint32_t), .corners = ktg_new(context, 3 * n, ktg_vec2), .turns = ktg_new(context, n, ktg_vec2)};
            status = ktg_seam_tabs_new(context, s.a, &w, &s.tabs);
            fprintf(stderr, "tabs start %g\n", s.tabs->price);
        }
        status = run(context, &s, (uint64_t)(work * P("WORK", 1)));
    }
    if (status == KTG_OK)
        for (uint32_t e = 0; e < dual->edge_count; e++) folded[e] = s.a->folded[e];
    ktg_seam_tabs_free(&s.tabs);
    ktg_free(s.saved.faces);
    ktg_free(s.saved.corners);
    ktg_free(s.saved.turns);
    ktg_arrangement_free(&s.a);
    ktg_free(s.area);
    ktg_free(s.cost);
    return status;
}
