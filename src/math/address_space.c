/* Room in the address space of the process, and its start anew. The Fortran side is blas_threads.f90. */
#define _GNU_SOURCE

#include <stdint.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

/* 1: so many bytes could be had at once. */
int gudgeon_has_room(int64_t bytes)
{
   void *place = mmap(NULL, (size_t)bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
   if (place == MAP_FAILED) return 0;
   munmap(place, (size_t)bytes);
   return 1;
}

/* 1: the address space is limited. */
int gudgeon_is_limited(void)
{
   struct rlimit limit;
   return getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
}

/* Begins this program anew with an environment variable set; returns only if that is not possible. */
void gudgeon_start_again(const char *name, const char *setting, int n, const char *arguments)
{
   char **vector = calloc((size_t)n + 1, sizeof *vector);
   if (vector == NULL || setenv(name, setting, 1) != 0) return;
   for (int k = 0; k < n; k++) {
      vector[k] = (char *)arguments;
      while (*arguments != '\0') arguments++;
      arguments++;
   }
   execv("/proc/self/exe", vector);
   free(vector);
}
