/* verify/verify.c - the order of the checks, and the list of problems (docs/verify.md). */
#include "core/memory.h"
#include "verify/check.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void ktg_check_problem(ktg_check *check, const char *format, ...) {
    if (check->report->problem_count < UINT32_MAX)
        check->report->problem_count++;
    if (check->report->problem_count > KTG_VERIFY_LISTED)
        return;
    size_t room = sizeof check->text - check->text_length;
    int length =
        snprintf(check->text + check->text_length, room, "%s", check->text_length ? "\n" : "");
    va_list arguments;
    va_start(arguments, format);
    int more = vsnprintf(check->text + check->text_length + length, room - (size_t)length, format,
                         arguments);
    va_end(arguments);
    check->text_length += (size_t)length;
    if (more > 0)
        check->text_length += (size_t)more;
    if (check->text_length >= sizeof check->text)
        check->text_length = sizeof check->text - 1;
}

static bool sound(const ktg_check *check) {
    return check->report->problem_count == 0;
}

/* A pattern straight from unfolding has faces and edges only. */
static bool is_finished(const ktg_pattern *p) {
    if (p->seam_count || p->sheet_count)
        return true;
    for (size_t i = 0; p->pieces && i < p->piece_count; i++)
        if (p->pieces[i].outline_count || p->pieces[i].tab_count || p->pieces[i].label_count)
            return true;
    return false;
}

static ktg_status take_memory(ktg_check *check) {
    const ktg_pattern *p = check->pattern;
    size_t halfedges = 3 * (size_t)p->face_count;
    check->twin = ktg_new(check->context, halfedges, uint32_t);
    check->edge_at = ktg_new(check->context, halfedges, uint32_t);
    check->fold = ktg_new(check->context, halfedges, uint8_t);
    check->face_component = ktg_new(check->context, p->face_count, uint32_t);
    check->face_piece = ktg_new(check->context, p->face_count, uint32_t);
    check->face_slot = ktg_new(check->context, p->face_count, uint32_t);
    check->width = ktg_new(check->context, p->face_count, double);
    check->reach2 = ktg_new(check->context, p->piece_count, double);
    bool all = check->twin && check->edge_at && check->fold && check->face_component &&
               check->face_piece && check->face_slot && check->width && check->reach2;
    return all ? KTG_OK : KTG_MEMORY;
}

static void give_back(ktg_check *check) {
    ktg_free(check->twin);
    ktg_free(check->edge_at);
    ktg_free(check->fold);
    ktg_free(check->face_component);
    ktg_free(check->face_piece);
    ktg_free(check->face_slot);
    ktg_free(check->width);
    ktg_free(check->reach2);
}

static ktg_status check_geometry(ktg_check *check) {
    bool paper = check->pattern->mode == KTG_PAPER;
    KTG_TRY(ktg_check_edges(check));
    ktg_check_lengths(check);
    if (paper)
        KTG_TRY(ktg_check_refold(check));
    KTG_TRY(ktg_check_cancel(check->context));
    KTG_TRY(ktg_check_pieces_apart(check));
    KTG_TRY(ktg_check_tabs(check));
    if (check->finished) {
        KTG_TRY(ktg_check_outlines(check));
        KTG_TRY(ktg_check_seams(check));
        if (!paper)
            KTG_TRY(ktg_check_cloth(check));
        ktg_check_labels(check);
    }
    return ktg_check_sheets(check);
}

/* Each stage stands on what the one before has shown; where that fails it would only repeat. */
static ktg_status check_all(ktg_check *check, const ktg_mesh *model) {
    KTG_TRY(ktg_check_form(check));
    if (!sound(check))
        return KTG_OK;
    KTG_TRY(take_memory(check));
    KTG_TRY(ktg_check_surface(check));
    if (!sound(check))
        return KTG_OK;
    if (model)
        KTG_TRY(ktg_check_model(check, model));
    uint32_t before = check->report->problem_count;
    KTG_TRY(ktg_check_faces(check));
    if (check->report->problem_count > before)
        return KTG_OK;
    KTG_TRY(ktg_check_components(check));
    return check_geometry(check);
}

static ktg_status conclude(ktg_check *check) {
    uint32_t count = check->report->problem_count;
    if (count == 0)
        return KTG_OK;
    if (count <= KTG_VERIFY_LISTED)
        return ktg_fail(check->context, KTG_UNSOUND, "%s", check->text);
    return ktg_fail(check->context, KTG_UNSOUND, "%s\n... and %u more", check->text,
                    count - KTG_VERIFY_LISTED);
}

ktg_status ktg_verify(ktg_context *context, const ktg_pattern *pattern, const ktg_mesh *model,
                      ktg_verify_report *report) {
    ktg_verify_report unwanted;
    if (!report)
        report = &unwanted;
    memset(report, 0, sizeof *report);
    if (!pattern)
        return ktg_fail(context, KTG_ARGUMENT, "no pattern was given to verify");
    ktg_check *check = ktg_new(context, 1, ktg_check);
    if (!check)
        return KTG_MEMORY;
    check->context = context;
    check->pattern = pattern;
    check->report = report;
    check->mm = 1;
    check->finished = is_finished(pattern);
    ktg_status status = check_all(check, model);
    if (status == KTG_OK)
        status = conclude(check);
    give_back(check);
    ktg_free(check);
    return status;
}
