/* Which edges of the program a deck went through, for `make fuzz SECONDS=`.
 *
 * Compiled with -fsanitize-coverage=trace-pc, a program calls __sanitizer_cov_trace_pc at the begin of each basic block. The
 * block that it came from and the block where it is are an edge. Edges are counted in a table by a hash of both; two edges of
 * one place there count as one. As fuzzers do, a count is known by its class only: 1, 2, 3, 4-7, 8-15, 16-31, 32-127, more.
 *
 * Classes that any deck has reached lie in a file that the fuzzer names in GUDGEON_COVERAGE, so that they outlive a process that
 * fell over and are shared among several. Without that file, or in a program compiled without the option, nothing is counted.
 */
#define _GNU_SOURCE

#include <fcntl.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

enum { n_places = 1 << 18 };

static uint8_t counts[n_places]; /* how often each edge was passed, at most 255 */
static uint8_t *reached;         /* (n_places) classes that any deck has reached, a bit each; NULL: nothing is counted */
static uintptr_t before;         /* the block before, halved */

/* Called at the begin of each block. */
void __sanitizer_cov_trace_pc(void)
{
   if (reached == NULL) return;
   /* relative to this program, wherever it was loaded; a multiplier spreads neighbours */
   uintptr_t place = (uintptr_t)__builtin_return_address(0) - (uintptr_t)&__sanitizer_cov_trace_pc;
   uintptr_t here = place * 0x9e3779b97f4a7c15u >> 40;
   uint8_t *count = &counts[(here ^ before) % n_places];
   if (*count < 255) ++*count;
   before = here >> 1;
}

/* A bit for the class of a count. */
static uint8_t class_of(uint8_t count)
{
   if (count <= 3) return (uint8_t)(1u << (count - 1));
   if (count < 8) return 8;
   if (count < 16) return 16;
   if (count < 32) return 32;
   return count < 128 ? 64 : 128;
}

/* Open the file of what was reached; 0, or 1 if it is named and cannot be had. */
int coverage_open(void)
{
   const char *name = getenv("GUDGEON_COVERAGE");
   if (name == NULL) return 0;
   int file = open(name, O_RDWR | O_CREAT | O_CLOEXEC, 0600);
   if (file < 0) return 1;
   void *place = MAP_FAILED;
   if (ftruncate(file, n_places) == 0) place = mmap(NULL, n_places, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
   close(file);
   if (place == MAP_FAILED) return 1;
   reached = place;
   return 0;
}

/* Begin with a deck. */
void coverage_begin(void)
{
   memset(counts, 0, sizeof counts);
   before = 0;
}

/* How many classes of edges the deck was the first to reach, and notes them; edges: how many it passed. */
int coverage_news(int *edges)
{
   int news = 0;
   *edges = 0;
   if (reached == NULL) return 0;
   for (size_t k = 0; k < n_places; k++) {
      if (counts[k] == 0) continue;
      uint8_t bit = class_of(counts[k]);
      ++*edges;
      if (reached[k] & bit) continue;
      reached[k] |= bit;
      news++;
   }
   return news;
}

/* Processor time of this process [us]. */
int64_t coverage_clock(void)
{
   struct timespec now;
   clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
   return (int64_t)now.tv_sec * 1000000 + now.tv_nsec / 1000;
}

/* Whether memory was lost since the last call: said on the standard error by the sanitizer's library, if it is there. */
#ifdef __SANITIZE_ADDRESS__
int __lsan_do_recoverable_leak_check(void);
int coverage_leaks(void) { return __lsan_do_recoverable_leak_check(); }
#else
int coverage_leaks(void) { return 0; }
#endif
