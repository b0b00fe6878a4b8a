/* Files that an animation page holds, put into the program by the assembler: three.js and our own below page/.
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
FILE_NAMED(page_data, "src/results/figures/page/data.js")
FILE_NAMED(page_solids, "src/results/figures/page/solids.js")
FILE_NAMED(page_scene, "src/results/figures/page/scene.js")
FILE_NAMED(page_view, "src/results/figures/page/view.js")
FILE_NAMED(page_plots, "src/results/figures/page/plots.js")
FILE_NAMED(page_player, "src/results/figures/page/player.js")

/* Bytes of a file and their number; the order is that of page_files.f90. */
const char *gudgeon_page_file(int number, size_t *n)
{
#define BOTH(name) {gudgeon_##name, gudgeon_##name##_end}
   const char *const files[][2] = {BOTH(page_head), BOTH(page_body), BOTH(page_licence), BOTH(page_three), BOTH(page_orbit),
                                   BOTH(page_data), BOTH(page_solids), BOTH(page_scene), BOTH(page_view), BOTH(page_plots),
                                   BOTH(page_player)};

   *n = (size_t)(files[number][1] - files[number][0]);
   return files[number][0];
}
