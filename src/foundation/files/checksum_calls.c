/* Checksums: of bytes, and of files that carry their own in a last line. The Fortran side is checksum.f90.
 *
 * A sum takes words of eight bytes one after the other: h = rotate(h ^ w P, 27) Q with odd P and Q. Every step is a bijection of h
 * and of w, so that one changed word always changes the sum; several do with a probability of 2^-64 of being missed. It finds
 * damage, not forgery. Constants: Y. Collet, xxHash, specification 0.1.1, XXH64. */
#define _GNU_SOURCE

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

int gudgeon_begin_child(int death, pid_t parent); /* of process_calls.c */
int gudgeon_exit_code(int status);

#define LAST_LINE "\ngudgeon checksum "
enum { digits = 16, seal_length = sizeof LAST_LINE - 1 + digits + 1, bytes_at_once = 1 << 18 };
enum { seal_none = 0, seal_right = 1, seal_wrong = 2, seal_unread = 3 };

static uint64_t add_word(uint64_t h, uint64_t w)
{
   h ^= w * UINT64_C(0xC2B2AE3D27D4EB4F);
   return (h << 27 | h >> 37) * UINT64_C(0x9E3779B185EBCA87);
}

/* The sum of a row of bytes behind others; its last word is filled up with zeros. */
static uint64_t add_bytes(uint64_t h, const unsigned char *bytes, int64_t n)
{
   uint64_t w;
   for (; n >= 8; n -= 8, bytes += 8) {
      memcpy(&w, bytes, 8);
      h = add_word(h, w);
   }
   if (n == 0) return h;
   w = 0;
   memcpy(&w, bytes, (size_t)n);
   return add_word(h, w);
}

/* Continues a checksum over rows of so many bytes each: it does not depend on how rows come together. */
void gudgeon_add_rows(uint64_t *sum, const unsigned char *bytes, int64_t n_rows, int64_t width)
{
   for (int64_t k = 0; k < n_rows; k++) *sum = add_bytes(*sum, bytes + k * width, width);
}

/* The sum of the first bytes of a file and of their number. 0, or an errno value. */
static int sum_of_file(int file, int64_t n, uint64_t *sum)
{
   unsigned char *bytes = malloc(bytes_at_once);
   if (bytes == NULL) return ENOMEM;
   int code = 0;
   *sum = add_word(0, (uint64_t)n);
   for (int64_t at = 0; at < n && code == 0;) {
      int64_t wanted = n - at < bytes_at_once ? n - at : bytes_at_once, had = 0;
      while (had < wanted && code == 0) {
         ssize_t got = pread(file, bytes + had, (size_t)(wanted - had), (off_t)(at + had));
         if (got > 0) had += got;
         else if (got == 0) code = EIO;
         else if (errno != EINTR) code = errno;
      }
      if (code == 0) *sum = add_bytes(*sum, bytes, wanted);
      at += wanted;
   }
   free(bytes);
   return code;
}

/* The line that a file ends with. */
static void write_seal(char *text, uint64_t sum)
{
   snprintf(text, seal_length + 1, LAST_LINE "%016" PRIx64 "\n", sum);
}

/* Appends to a file the line with its checksum. 0, or an errno value; the file is then as before. */
int gudgeon_seal(const char *path)
{
   int file = open(path, O_RDWR | O_CLOEXEC | O_NOFOLLOW);
   if (file < 0) return errno;
   struct stat status;
   uint64_t sum;
   int code = fstat(file, &status) == 0 ? sum_of_file(file, (int64_t)status.st_size, &sum) : errno;
   if (code == 0) {
      char text[seal_length + 1];
      write_seal(text, sum);
      ssize_t written = pwrite(file, text, seal_length, status.st_size);
      if (written != seal_length) {
         code = written < 0 ? errno : ENOSPC;
         if (ftruncate(file, status.st_size) != 0) code = errno;
      }
   }
   if (close(file) != 0 && code == 0) code = errno;
   return code;
}

/* Whether a file carries its checksum, and whether that is right. */
int gudgeon_seal_state(const char *path)
{
   int file = open(path, O_RDONLY | O_CLOEXEC);
   if (file < 0) return seal_unread;
   struct stat status;
   char text[seal_length + 1] = "", right[seal_length + 1];
   uint64_t sum;
   int state = seal_unread;
   if (fstat(file, &status) == 0 && S_ISREG(status.st_mode)) {
      int64_t n = (int64_t)status.st_size - seal_length;
      state = seal_none;
      if (n >= 0 && pread(file, text, seal_length, (off_t)n) == seal_length &&
          memcmp(text, LAST_LINE, sizeof LAST_LINE - 1) == 0) {
         state = seal_wrong;
         if (sum_of_file(file, n, &sum) == 0) {
            write_seal(right, sum);
            if (memcmp(text, right, seal_length) == 0) state = seal_right;
         }
      }
   }
   close(file);
   return state;
}

/* Makes a copy of this process for an attempt that may end it: its number, 0 in the copy, negative: none could be made. It is silent,
 * and has so many seconds of processor time and so many bytes more than it has. */
int gudgeon_begin_attempt(int seconds, int64_t bytes)
{
   fflush(NULL);
   pid_t parent = getpid(), child = fork();
   if (child != 0) return (int)child;
   if (gudgeon_begin_child(SIGKILL, parent) != 0) _exit(1);
   int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
   if (nothing < 0 || dup2(nothing, 1) < 0 || dup2(nothing, 2) < 0) _exit(1);
   struct rlimit limit = {(rlim_t)seconds, (rlim_t)seconds + 1};
   setrlimit(RLIMIT_CPU, &limit);
   limit = (struct rlimit){0, 0};
   setrlimit(RLIMIT_CORE, &limit);
#ifndef __SANITIZE_ADDRESS__
   long pages = 0;
   FILE *own = fopen("/proc/self/statm", "r");
   if (own != NULL) {
      if (fscanf(own, "%ld", &pages) == 1 && pages > 0) {
         rlim_t all = (rlim_t)pages * (rlim_t)sysconf(_SC_PAGESIZE) + (rlim_t)bytes;
         limit = (struct rlimit){all, all};
         setrlimit(RLIMIT_AS, &limit);
      }
      fclose(own);
   }
#else
   (void)bytes;
#endif
   return 0;
}

/* Waits for the attempt: its exit code, 128 + signal if one ended it. */
int gudgeon_end_attempt(int process)
{
   int status = 0;
   while (waitpid((pid_t)process, &status, 0) < 0)
      if (errno != EINTR) return 1;
   return gudgeon_exit_code(status);
}

/* Bytes of a file; negative: there is none. */
int64_t gudgeon_size_of(const char *path)
{
   struct stat status;
   return stat(path, &status) == 0 ? (int64_t)status.st_size : -1;
}

/* Which file a path names, links not followed: its number in the file system, and its bytes. 0, or an errno value. */
int gudgeon_identity(const char *path, int64_t *identity)
{
   struct stat status;
   if (lstat(path, &status) != 0) return errno;
   identity[0] = (int64_t)status.st_ino;
   identity[1] = S_ISREG(status.st_mode) ? (int64_t)status.st_size : 0;
   return 0;
}
