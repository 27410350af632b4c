#ifndef KTG_UNFOLD_ARRANGE_H
#define KTG_UNFOLD_ARRANGE_H
#include "unfold/arrangement.h"
#include "unfold/search.h"
ktg_status ktg_arrange_run(ktg_context *context, const ktg_dual *dual, bool *folded, double aspect, uint64_t work, ktg_search *search);
#endif
