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

#ifdef __linux__
/* Before the constructors of the libraries: that of OpenBLAS 0.3.29 asks for a buffer for each of its threads, one at least, again and
   again, for ever if there is no room. So where the address space is limited the program begins anew with one thread, and ends
   with code 9 where there is no room either for its buffer and what the constructors before it take (UCX, of MPI, 18 MB).
   Nothing of a library is called but system calls. */
static void begin_with_one_thread(int argc, char **argv, char **environment)
{
   static char setting[] = "OPENBLAS_NUM_THREADS=1";
   static const char words[] = "error: too little memory may be used: the libraries need 160 MB more than are left (ulimit -v limits the "
                               "address space)\n";
   const int64_t buffer_of_blas = INT64_C(128) << 20, others = INT64_C(32) << 20;
   enum { most = 4096 };
   static char *larger[most + 2];
   struct rlimit limit;
   int n = 0;
   (void)argc;
   if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return;
   if (!gudgeon_has_room(buffer_of_blas + others)) {
      ssize_t said = write(STDERR_FILENO, words, sizeof words - 1);
      (void)said;  /* there is no one to tell if that fails */
      _exit(9);
   }
   for (; environment[n] != NULL; n++) {
      int k = 0;
      while (setting[k] != '=' && environment[n][k] == setting[k]) k++;
      if ((setting[k] == '=' && environment[n][k] == '=') || n == most) return;
      larger[n] = environment[n];
   }
   larger[n] = setting;
   execve("/proc/self/exe", argv, larger);
}

__attribute__((section(".preinit_array"), used)) static void (*const first_of_all)(int, char **, char **) = begin_with_one_thread;
#endif

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
