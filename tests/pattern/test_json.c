/* The pattern's JSON form: there and back. */
#include "json_files.h"

#include "core/memory.h"
#include "tests/short_memory.h"

#include <locale.h>
#include <math.h>
#include <unistd.h>

#define assert_same_array(a, b, count, items)                                                      \
    assert_memory_equal((a)->items, (b)->items, (count) * sizeof *(a)->items)

static void assert_same_piece(const ktg_pattern_piece *a, const ktg_pattern_piece *b) {
    assert_int_equal(a->component, b->component);
    assert_int_equal(a->name == NULL, b->name == NULL);
    if (a->name)
        assert_string_equal(a->name, b->name);
    assert_int_equal(a->vertex_count, b->vertex_count);
    assert_same_array(a, b, a->vertex_count, vertices);
    assert_int_equal(a->face_count, b->face_count);
    assert_same_array(a, b, a->face_count, faces);
    assert_same_array(a, b, 3 * a->face_count, corners);
    assert_int_equal(a->outline_count, b->outline_count);
    if (a->outline)
        assert_same_array(a, b, a->outline_count, outline);
    else
        assert_null(b->outline);
    assert_int_equal(a->tab_count, b->tab_count);
    for (size_t i = 0; i < a->tab_count; i++) {
        assert_int_equal(a->tabs[i].edge, b->tabs[i].edge);
        assert_int_equal(a->tabs[i].size, b->tabs[i].size);
        assert_int_equal(a->tabs[i].corner_count, b->tabs[i].corner_count);
        assert_memory_equal(a->tabs[i].corners, b->tabs[i].corners, sizeof a->tabs[i].corners);
    }
    assert_int_equal(a->line_count, b->line_count);
    for (size_t i = 0; i < a->line_count; i++) {
        assert_int_equal(a->lines[i].kind, b->lines[i].kind);
        assert_int_equal(a->lines[i].point_count, b->lines[i].point_count);
        assert_same_array(&a->lines[i], &b->lines[i], a->lines[i].point_count, points);
    }
    assert_int_equal(a->label_count, b->label_count);
    for (size_t i = 0; i < a->label_count; i++) {
        assert_memory_equal(a->labels[i].text, b->labels[i].text, sizeof a->labels[i].text);
        assert_memory_equal(&a->labels[i].at, &b->labels[i].at, sizeof(ktg_vec2));
        assert_true(fabs(a->labels[i].rotation - b->labels[i].rotation) <=
                    1e-15 * fabs(a->labels[i].rotation));
        assert_true(a->labels[i].height_mm == b->labels[i].height_mm);
        assert_int_equal(a->labels[i].edge, b->labels[i].edge);
        assert_int_equal(a->labels[i].leader, b->labels[i].leader);
        assert_memory_equal(&a->labels[i].foot, &b->labels[i].foot, sizeof(ktg_vec2));
    }
    assert_int_equal(a->cut_count, b->cut_count);
    assert_int_equal(a->cut_mirrored, b->cut_mirrored);
    assert_int_equal(a->on_fold, b->on_fold);
    if (a->cut_count == 0)
        assert_int_equal(a->twin_of, b->twin_of);
}

static void assert_same_edge(const ktg_pattern_edge *a, const ktg_pattern_edge *b) {
    assert_memory_equal(a->vertices, b->vertices, sizeof a->vertices);
    assert_int_equal(a->kind, b->kind);
    assert_true(fabs(a->angle - b->angle) <= 1e-15 * fabs(a->angle));
    assert_int_equal(a->side_count, b->side_count);
    assert_memory_equal(a->sides, b->sides, a->side_count * sizeof *a->sides);
    assert_int_equal(a->tab_on, b->tab_on);
    assert_int_equal(a->seam, b->seam);
    assert_int_equal(a->forced, b->forced);
}

static void assert_same_seam(const ktg_pattern_seam *a, const ktg_pattern_seam *b) {
    assert_int_equal(a->edge_count, b->edge_count);
    assert_same_array(a, b, a->edge_count, edges);
    assert_same_array(a, b, a->edge_count, first_side);
    assert_memory_equal(a->pieces, b->pieces, sizeof a->pieces);
    assert_memory_equal(a->lengths_mm, b->lengths_mm, sizeof a->lengths_mm);
    assert_int_equal(a->obvious, b->obvious);
    assert_int_equal(a->dart, b->dart);
    assert_int_equal(a->number, b->number);
    assert_int_equal(a->section, b->section);
    assert_int_equal(a->closing, b->closing);
    assert_int_equal(a->notch_count, b->notch_count);
    for (size_t i = 0; i < a->notch_count; i++) {
        assert_true(a->notches[i].at == b->notches[i].at);
        assert_int_equal(a->notches[i].marks, b->notches[i].marks);
    }
}

static void assert_same_sheet(const ktg_pattern_sheet *a, const ktg_pattern_sheet *b) {
    assert_int_equal(a->kind, b->kind);
    assert_int_equal(a->poster, b->poster);
    assert_int_equal(a->row, b->row);
    assert_int_equal(a->column, b->column);
    assert_true(a->width_mm == b->width_mm && a->height_mm == b->height_mm);
    assert_memory_equal(a->printable, b->printable, sizeof a->printable);
    assert_int_equal(a->placement_count, b->placement_count);
    for (size_t i = 0; i < a->placement_count; i++) {
        assert_int_equal(a->placements[i].piece, b->placements[i].piece);
        assert_true(a->placements[i].x == b->placements[i].x);
        assert_true(a->placements[i].y == b->placements[i].y);
        assert_true(fabs(a->placements[i].rotation - b->placements[i].rotation) <=
                    1e-15 * fabs(a->placements[i].rotation));
    }
}

static void assert_same_pattern(const ktg_pattern *a, const ktg_pattern *b) {
    assert_int_equal(a->mode, b->mode);
    assert_string_equal(a->model_file, b->model_file);
    assert_int_equal(a->model_faces, b->model_faces);
    assert_true(a->mm_per_unit == b->mm_per_unit);
    assert_int_equal(a->simplified, b->simplified);
    assert_int_equal(a->omitted_count, b->omitted_count);
    for (size_t i = 0; i < a->omitted_count; i++)
        assert_string_equal(a->omitted[i], b->omitted[i]);
    assert_int_equal(a->vertex_count, b->vertex_count);
    assert_same_array(a, b, a->vertex_count, vertices);
    assert_int_equal(a->face_count, b->face_count);
    assert_same_array(a, b, 3 * a->face_count, faces);
    assert_same_array(a, b, a->face_count, face_strain);
    assert_int_equal(a->component_count, b->component_count);
    assert_string_equal(a->components[0].name, b->components[0].name);
    assert_null(b->components[1].name);
    assert_int_equal(a->piece_count, b->piece_count);
    for (size_t i = 0; i < a->piece_count; i++)
        assert_same_piece(&a->pieces[i], &b->pieces[i]);
    assert_int_equal(a->edge_count, b->edge_count);
    for (size_t i = 0; i < a->edge_count; i++)
        assert_same_edge(&a->edges[i], &b->edges[i]);
    assert_int_equal(a->seam_count, b->seam_count);
    for (size_t i = 0; i < a->seam_count; i++)
        assert_same_seam(&a->seams[i], &b->seams[i]);
    assert_int_equal(a->sheet_count, b->sheet_count);
    for (size_t i = 0; i < a->sheet_count; i++)
        assert_same_sheet(&a->sheets[i], &b->sheets[i]);
}

static void a_pattern_reads_back_to_the_same_bits(void **state) {
    fixture *f = *state;
    ktg_pattern *pattern = make_pattern(f->context), *back = NULL;
    assert_int_equal(write_to(f, pattern, f->path), KTG_OK);
    assert_int_equal(ktg_pattern_read_json(f->context, f->path, &back), KTG_OK);
    assert_same_pattern(pattern, back);
    assert_int_equal(write_to(f, back, f->other), KTG_OK);
    assert_same_file(f);
    ktg_pattern_free(&pattern);
    ktg_pattern_free(&back);
}

static void every_angle_survives_degrees(void **state) {
    fixture *f = *state;
    ktg_pattern *pattern = make_pattern(f->context), *back = NULL;
    ktg_free(pattern->pieces[1].labels);
    size_t count = pattern->pieces[1].label_count = 20000;
    ktg_pattern_label *labels = pattern->pieces[1].labels =
        ktg_new(f->context, count, ktg_pattern_label);
    for (size_t i = 0; i < count; i++)
        labels[i] = (ktg_pattern_label){"7", {0, 0}, sin((double)i) * pow(10, i % 17 - 14.0), 2, 2};
    assert_int_equal(write_to(f, pattern, f->path), KTG_OK);
    assert_int_equal(ktg_pattern_read_json(f->context, f->path, &back), KTG_OK);
    for (size_t i = 0; i < count; i++)
        assert_true(fabs(labels[i].rotation - back->pieces[1].labels[i].rotation) <=
                    1e-15 * fabs(labels[i].rotation));
    ktg_pattern_free(&pattern);
    assert_int_equal(write_to(f, back, f->path), KTG_OK);
    ktg_pattern_free(&back);
    assert_int_equal(ktg_pattern_read_json(f->context, f->path, &back), KTG_OK);
    assert_int_equal(write_to(f, back, f->other), KTG_OK);
    assert_same_file(f); /* a pattern that was read once does not change any more */
    ktg_pattern_free(&back);
}

static void short_numbers_stay_short(void **state) {
    fixture *f = *state;
    ktg_pattern *pattern = make_pattern(f->context);
    assert_int_equal(write_to(f, pattern, f->path), KTG_OK);
    char *text = slurp(f, f->path);
    assert_non_null(strstr(text, "\"mm_per_unit\":0.1,"));
    assert_non_null(strstr(text, "\"angle_deg\":45,"));
    assert_non_null(strstr(text, "{\"piece\":2,\"x\":12.5,\"y\":40.1,\"rotation_deg\":90}"));
    assert_non_null(strstr(text, "\n\"edges\":["));
    ktg_free(text);
    ktg_pattern_free(&pattern);
}

static void the_locale_changes_nothing(void **state) {
    fixture *f = *state;
    static const char *const names[] = {"de_DE.UTF-8", "de_DE", "fr_FR.UTF-8", "C.UTF-8"};
    ktg_pattern *pattern = make_pattern(f->context), *back = NULL;
    assert_int_equal(write_to(f, pattern, f->path), KTG_OK);
    for (size_t i = 0; i < 4; i++)
        if (setlocale(LC_ALL, names[i]))
            break;
    assert_int_equal(write_to(f, pattern, f->other), KTG_OK);
    assert_int_equal(ktg_pattern_read_json(f->context, f->other, &back), KTG_OK);
    setlocale(LC_ALL, "C");
    assert_same_file(f);
    assert_same_pattern(pattern, back);
    ktg_pattern_free(&pattern);
    ktg_pattern_free(&back);
}

static void a_number_without_a_form_is_not_written(void **state) {
    fixture *f = *state;
    ktg_pattern *pattern = make_pattern(f->context);
    pattern->pieces[0].vertices[1].x = NAN;
    assert_int_equal(write_to(f, pattern, f->path), KTG_ARGUMENT);
    assert_int_not_equal(access(f->path, F_OK), 0);
    pattern->pieces[0].vertices[1].x = 1;
    pattern->pieces[0].component = 2;
    assert_int_equal(write_to(f, pattern, f->path), KTG_ARGUMENT);
    ktg_pattern_free(&pattern);
}

static void a_name_that_is_no_utf8_is_written_with_question_marks(void **state) {
    fixture *f = *state;
    ktg_pattern *pattern = make_pattern(f->context), *back = NULL;
    ktg_free(pattern->model_file);
    pattern->model_file = ktg_copy_text(f->context, "f\xfc.obj", SIZE_MAX);
    assert_int_equal(write_to(f, pattern, f->path), KTG_OK);
    assert_int_equal(ktg_pattern_read_json(f->context, f->path, &back), KTG_OK);
    assert_string_equal(back->model_file, "f?.obj");
    ktg_pattern_free(&pattern);
    ktg_pattern_free(&back);
}

/* Multiplies every id of the file, turns the order of pieces and edges round, and drops what may be
 * missing: what another program might write. */
static void files_of_other_programs_are_understood(void **state) {
    fixture *f = *state;
    static const char *const text =
        "{\"mode\":\"paper\",\"units\":\"mm\",\"version\":1,\"format\":\"katagami-pattern\",\"x\":{"
        "},"
        "\"model\":{\"file\":null,\"faces\":2,\"mm_per_unit\":1,\"simplified\":false,\"by\":\"me\"}"
        ","
        "\"mesh\":{\"vertices\":[[0,0,0],[1,0,0],[0,1,0],[1,1,0.5]],\"faces\":[[0,1,2],[2,1,3]],"
        "\"uv\":[1,2,3],\"face_strain\":null},"
        "\"pieces\":[{\"id\":70,\"name\":\"b\",\"vertices\":[[0,1],[1,0],[1,1.1]],"
        "\"faces\":[{\"face\":1,\"corners\":[0,1,2]}],\"outline\":[],"
        "\"tabs\":[{\"edge\":-3,\"polygon\":[[0,1],[0.2,0.5],[1,0]]}],\"lines\":[],"
        "\"labels\":[{\"text\":\"1\",\"x\":1,\"y\":0}],\"cut\":{\"count\":1,\"mirrored\":0}},"
        "{\"id\":-5,\"name\":\"a\",\"vertices\":[[0,0],[1,0],[0,1]],"
        "\"faces\":[{\"face\":0,\"corners\":[0,1,2]}],\"outline\":[],\"tabs\":[],\"lines\":[],"
        "\"labels\":[],\"cut\":{\"count\":1,\"mirrored\":0}}],"
        "\"components\":[{\"id\":0,\"name\":\"all\",\"pieces\":[-5,70]}],"
        "\"edges\":[{\"id\":900,\"vertices\":[0,1],\"kind\":\"border\",\"angle_deg\":0,"
        "\"sides\":[{\"piece\":-5,\"face\":0,\"corner\":0}],\"tab_on\":null},"
        "{\"id\":-3,\"vertices\":[1,2],\"kind\":\"cut\",\"angle_deg\":-10,"
        "\"sides\":[{\"piece\":-5,\"face\":0,\"corner\":1},{\"piece\":70,\"face\":1,\"corner\":0}],"
        "\"tab_on\":1}],"
        "\"seams\":[{\"id\":4,\"sides\":[{\"piece\":70,\"edges\":[-3],\"length_mm\":1.5},"
        "{\"piece\":-5,\"edges\":[-3],\"length_mm\":1.5}]}],"
        "\"sheets\":[]}";
    ktg_pattern *p = NULL;
    write_bytes(f->path, text, strlen(text));
    if (ktg_pattern_read_json(f->context, f->path, &p) != KTG_OK)
        fail_msg("%s", ktg_context_message(f->context));
    assert_int_equal(p->pieces[0].tabs[0].edge, 1);
    assert_int_equal(p->pieces[0].tabs[0].size, KTG_TAB_FULL);
    assert_true(p->pieces[0].labels[0].height_mm > 0);
    assert_int_equal(p->pieces[0].labels[0].edge, KTG_NONE);
    assert_int_equal(p->edges[1].sides[0].piece, 1);
    assert_int_equal(p->edges[1].sides[1].piece, 0);
    assert_int_equal(p->edges[1].tab_on, 1);
    assert_int_equal(p->edges[1].seam, 0);
    assert_int_equal(p->seams[0].pieces[0], 0);
    assert_int_equal(p->seams[0].first_side[0], 1); /* the side in piece 70 */
    assert_null(p->model_file);
    assert_null(p->face_strain);
    assert_null(p->pieces[0].outline);
    assert_int_equal(write_to(f, p, f->path), KTG_OK);
    ktg_pattern_free(&p);
    assert_int_equal(ktg_pattern_read_json(f->context, f->path, &p), KTG_OK);
    assert_int_equal(write_to(f, p, f->other), KTG_OK);
    assert_same_file(f);
    ktg_pattern_free(&p);
}

static void memory_may_fail_anywhere(void **state) {
    fixture *f = *state;
    ktg_pattern *pattern = make_pattern(f->context), *back = NULL;
    assert_int_equal(write_to(f, pattern, f->path), KTG_OK);
    ktg_status status = KTG_MEMORY;
    uint64_t nth = 0;
    while (status == KTG_MEMORY) {
        ktg_context_fail_allocation(f->context, ++nth);
        status = ktg_pattern_read_json(f->context, f->path, &back);
        assert_int_equal(back == NULL, status == KTG_MEMORY);
    }
    assert_int_equal(status, KTG_OK);
    assert_same_pattern(pattern, back);
    assert_true(nth > 20);
    for (nth = 1, status = KTG_MEMORY; status == KTG_MEMORY; nth++) {
        ktg_context_fail_allocation(f->context, nth);
        status = write_to(f, pattern, f->other);
    }
    assert_int_equal(status, KTG_OK);
    assert_true(nth > 4);
    end_short_memory(f->context, status);
    assert_same_file(f);
    ktg_pattern_free(&pattern);
    ktg_pattern_free(&back);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        CASE(a_pattern_reads_back_to_the_same_bits),
        CASE(every_angle_survives_degrees),
        CASE(short_numbers_stay_short),
        CASE(the_locale_changes_nothing),
        CASE(a_number_without_a_form_is_not_written),
        CASE(a_name_that_is_no_utf8_is_written_with_question_marks),
        CASE(files_of_other_programs_are_understood),
        CASE(memory_may_fail_anywhere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
