/* bench/table.h - the figures as a table, and as JSON. */
#ifndef KTG_BENCH_TABLE_H
#define KTG_BENCH_TABLE_H

#include "bench/measure.h"

#include <stdio.h>

void bench_table_head(const bench_settings *settings);
void bench_table_row(const bench_settings *settings, const char *name, const bench_figures *f);
/* The median of each column over all models, and the worst. */
void bench_table_summary(const bench_settings *settings, const bench_figures *all, size_t count);

/* {"settings": ..., "models": {NAME: {...}, ...}, "median": {...}, "worst": {...}} */
void bench_json(FILE *file, const bench_settings *settings, const char *const *names,
                const bench_figures *all, size_t count);

#endif
