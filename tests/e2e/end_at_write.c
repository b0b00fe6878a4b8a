/* Preloaded before the program: a SIGKILL at the n-th write to run.h5, or another file (-DNAME), with GUDGEON_KILL_AT=n. With
 * GUDGEON_COPY_AT=n,m,... (in order) the file is copied to GUDGEON_COPIES/n, ... instead, before the n-th write: what a SIGKILL there
 * leaves, of one run for all. Without both each write is a line on the standard error. A write at a place is one for each page, as the
 * system makes it; a node or a heap in two pages is a line, too. */
#define _GNU_SOURCE

#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

#ifndef NAME
#define NAME "run.h5"
#endif

static long n = 0;

typedef ssize_t write_t(int, const void *, size_t);
typedef ssize_t pwrite_t(int, const void *, size_t, off_t);

static void copy(int file)
{
   static char bytes[1 << 16];
   char path[4096];
   snprintf(path, sizeof path, "%s/%ld", getenv("GUDGEON_COPIES"), n);
   const int to = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0644);
   write_t *write_there = (write_t *)dlsym(RTLD_NEXT, "write");
   ssize_t size;
   for (off_t at = 0; (size = pread(file, bytes, sizeof bytes, at)) > 0; at += size) {
      if (write_there(to, bytes, (size_t)size) != size) abort();
   }
   if (size < 0 || close(to) != 0) abort();
}

static void count(int file)
{
   static const char *copies = NULL;
   char link[64], path[4096];
   snprintf(link, sizeof link, "/proc/self/fd/%d", file);
   ssize_t length = readlink(link, path, sizeof path);
   const ssize_t n_name = sizeof NAME;  /* with the slash before it */
   if (length < n_name || memcmp(path + length - n_name, "/" NAME, n_name) != 0) return;
   const char *kill_at = getenv("GUDGEON_KILL_AT");
   if (++n == 1) copies = getenv("GUDGEON_COPY_AT");
   if (kill_at != NULL) {
      if (n == atol(kill_at)) kill(getpid(), SIGKILL);
   } else if (copies == NULL) {
      fputs("write to " NAME "\n", stderr);
   } else if (n == atol(copies)) {
      copy(file);
      copies += strcspn(copies, ",");
      copies += *copies == ',';
   }
}

ssize_t write(int file, const void *bytes, size_t size)
{
   count(file);
   return ((write_t *)dlsym(RTLD_NEXT, "write"))(file, bytes, size);
}

static ssize_t write_pages(int file, const char *bytes, size_t size, off_t at)
{
   enum { page = 4096 };
   static const char *const signatures[] = {"TREE", "SNOD", "HEAP"};
   const int is_short = size <= page && (size_t)(at % page) + size > page;
   for (int k = 0; k < 3; k++) {
      if (is_short && memcmp(bytes, signatures[k], 4) == 0) fprintf(stderr, "%s in two pages\n", signatures[k]);
   }
   size_t done = 0;
   while (done < size) {
      size_t part = page - (size_t)(at + (off_t)done) % page;
      if (part > size - done) part = size - done;
      count(file);
      ssize_t n_written = ((pwrite_t *)dlsym(RTLD_NEXT, "pwrite"))(file, bytes + done, part, at + (off_t)done);
      if (n_written <= 0) return done > 0 ? (ssize_t)done : n_written;
      done += (size_t)n_written;
   }
   return (ssize_t)done;
}

ssize_t pwrite(int file, const void *bytes, size_t size, off_t at) { return write_pages(file, bytes, size, at); }

ssize_t pwrite64(int file, const void *bytes, size_t size, off_t at) { return write_pages(file, bytes, size, at); }

static ssize_t write_pieces(int file, const struct iovec *pieces, int n, off_t at)
{
   ssize_t done = 0;
   for (int k = 0; k < n; k++) {
      ssize_t n_written = write_pages(file, pieces[k].iov_base, pieces[k].iov_len, at + (off_t)done);
      if (n_written < 0) return done > 0 ? done : n_written;
      done += n_written;
      if ((size_t)n_written < pieces[k].iov_len) break;
   }
   return done;
}

ssize_t pwritev(int file, const struct iovec *pieces, int n, off_t at) { return write_pieces(file, pieces, n, at); }

ssize_t pwritev64(int file, const struct iovec *pieces, int n, off_t at) { return write_pieces(file, pieces, n, at); }
