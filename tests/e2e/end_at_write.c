/* Preloaded before the program: a SIGKILL at the n-th write to run.h5, or another file (-DNAME), with GUDGEON_KILL_AT=n. Without it each of
 * them is a line on the standard error. */
#define _GNU_SOURCE

#include <dlfcn.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <unistd.h>

#ifndef NAME
#define NAME "run.h5"
#endif

static long n = 0;

static void count(int file)
{
   char link[64], path[4096];
   snprintf(link, sizeof link, "/proc/self/fd/%d", file);
   ssize_t length = readlink(link, path, sizeof path);
   const ssize_t n_name = sizeof NAME;  /* with the slash before it */
   if (length < n_name || memcmp(path + length - n_name, "/" NAME, n_name) != 0) return;
   const char *at = getenv("GUDGEON_KILL_AT");
   if (at == NULL) fputs("write to " NAME "\n", stderr);
   else if (++n == atol(at)) kill(getpid(), SIGKILL);
}

typedef ssize_t write_t(int, const void *, size_t);
typedef ssize_t pwrite_t(int, const void *, size_t, off_t);

ssize_t write(int file, const void *bytes, size_t size)
{
   count(file);
   return ((write_t *)dlsym(RTLD_NEXT, "write"))(file, bytes, size);
}

ssize_t pwrite(int file, const void *bytes, size_t size, off_t at)
{
   count(file);
   return ((pwrite_t *)dlsym(RTLD_NEXT, "pwrite"))(file, bytes, size, at);
}

ssize_t pwrite64(int file, const void *bytes, size_t size, off_t at)
{
   count(file);
   return ((pwrite_t *)dlsym(RTLD_NEXT, "pwrite"))(file, bytes, size, at);
}
