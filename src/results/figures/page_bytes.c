/* Files that pages hold, put into the program by the assembler: three.js and our own below page/.
 *
 * The Fortran side is page_files.f90. make gives THREE, the folder of three.js, and runs the compiler at the root of the source tree. */
#include <stddef.h>

#define FILE_NAMED(name, path) \
   extern const char gudgeon_##name[], gudgeon_##name##_end[]; \
   __asm__(".section .rodata\n.globl gudgeon_" #name "\n.globl gudgeon_" #name "_end\ngudgeon_" #name ":\n" \
           ".incbin \"" path "\"\ngudgeon_" #name "_end:\n.byte 0\n.previous");

FILE_NAMED(page_head, "src/results/figures/page/page.html")
FILE_NAMED(page_body, "src/results/figures/page/body.html")
FILE_NAMED(page_licence, "src/results/figures/page/three_licence.txt")
FILE_NAMED(page_three, THREE "/build/three.min.js")
FILE_NAMED(page_orbit, THREE "/examples/js/controls/OrbitControls.js")
FILE_NAMED(page_study, "src/results/figures/page/study.html")
FILE_NAMED(page_numbers, "src/results/figures/page/numbers.js")
FILE_NAMED(page_curves, "src/results/figures/page/curves.js")
FILE_NAMED(page_data, "src/results/figures/page/data.js")
FILE_NAMED(page_solids, "src/results/figures/page/solids.js")
FILE_NAMED(page_scene, "src/results/figures/page/scene.js")
FILE_NAMED(page_view, "src/results/figures/page/view.js")
FILE_NAMED(page_plots, "src/results/figures/page/plots.js")
FILE_NAMED(page_player, "src/results/figures/page/player.js")
FILE_NAMED(page_axes, "src/results/figures/page/axes.js")
FILE_NAMED(page_results, "src/results/figures/page/results.js")
FILE_NAMED(page_runs, "src/results/figures/page/runs.js")
FILE_NAMED(page_study_style, "src/results/figures/page/study_style.html")
FILE_NAMED(page_chart, "src/results/figures/page/chart.js")
FILE_NAMED(page_distribution, "src/results/figures/page/distribution.js")

/* Bytes of a file and their number; the order is that of page_files.f90. */
const char *gudgeon_page_file(int number, size_t *n)
{
#define BOTH(name) {gudgeon_##name, gudgeon_##name##_end}
   const char *const files[][2] = {BOTH(page_head), BOTH(page_body), BOTH(page_licence), BOTH(page_three), BOTH(page_orbit),
                                   BOTH(page_study), BOTH(page_numbers), BOTH(page_curves), BOTH(page_data), BOTH(page_solids),
                                   BOTH(page_scene), BOTH(page_view), BOTH(page_plots), BOTH(page_player), BOTH(page_axes),
                                   BOTH(page_results), BOTH(page_runs), BOTH(page_study_style), BOTH(page_chart),
                                   BOTH(page_distribution)};

   *n = (size_t)(files[number][1] - files[number][0]);
   return files[number][0];
}
