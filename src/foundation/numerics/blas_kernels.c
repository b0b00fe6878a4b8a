/* The same bits on every node: OpenBLAS takes the kernels that suit the processor it is loaded on, and these round differently.
 *
 * It reads the environment variable OPENBLAS_CORETYPE as it is loaded, before any line of this program; what the program sets
 * would come too late. So the program has a getenv of its own, which libraries find before that of the C library: where the
 * variable is not set it answers with the kernels of the oldest processors that have the instructions AVX2 and FMA, which all
 * newer ones have too. The matrices of a mechanism are small; wider registers gain nothing on them. Limits: processors without
 * these instructions choose for themselves, as does any other BLAS; GNU C library.
 */
#include <stdlib.h>
#include <string.h>

extern char **environ;

static const char variable[] = "OPENBLAS_CORETYPE";

static char *value_of(const char *name)
{
   size_t n = strlen(name);
   if (environ == NULL || n == 0) return NULL;
   for (char **entry = environ; *entry != NULL; entry++)
      if (strncmp(*entry, name, n) == 0 && (*entry)[n] == '=') return *entry + n + 1;
   return NULL;
}

char *getenv(const char *name)
{
   char *value = value_of(name);
#if defined(__x86_64__) && defined(__GNUC__)
   static char common[] = "Haswell";
   if (value == NULL && strcmp(name, variable) == 0) {
      __builtin_cpu_init();
      if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return common;
   }
#endif
   return value;
}
