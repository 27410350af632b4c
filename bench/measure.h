/* bench/measure.h - what is measured about one model. */
#ifndef KTG_BENCH_MEASURE_H
#define KTG_BENCH_MEASURE_H

#include "unfold/unfold.h"

#define BENCH_MOST_SEEDS 100
#define BENCH_EFFORTS    3 /* quick, normal, best */

/* What the command line says. */
typedef struct bench_settings {
    bool genetic;
    uint32_t faces;  /* larger models are simplified to so many; 0: all are taken as they are */
    int seeds;       /* nets per model, for the seconds */
    int sheet_seeds; /* of those, how many are put on a sheet; figures are their mean */
    bool efforts[BENCH_EFFORTS]; /* which ones to measure; seconds are those of the first */
} bench_settings;

/* One sheet of A4 at one effort. */
typedef struct bench_sheet {
    double fill;                /* area of the faces over printable area, with tabs of 5 mm */
    double bare_fill;           /* the same without tabs */
    double seconds;             /* for the net */
    double full, reduced, none; /* percent of the cut edges of 4 mm and more */
    double seams;               /* such edges */
} bench_sheet;

/* Plain data: it goes through a pipe. */
typedef struct bench_figures {
    uint32_t faces, components, most_pieces;
    int one_piece;          /* runs with as few pieces as there can be */
    double median, slowest; /* seconds: to one piece, or of the whole run where there are more */
    double steps;           /* median */
    double megabytes;       /* the largest memory at any time */
    bench_sheet sheets[BENCH_EFFORTS];
} bench_figures;

const char *bench_effort_name(int effort);

/* Measures in a process of its own, so that memory is the model's own and a crash is only its.
 * False, with a sentence on standard error, when something failed. */
bool bench_measure(const bench_settings *settings, const char *path, bench_figures *figures);

double bench_median(double *numbers, int count); /* sorts them */

#endif
