/* Whole files and streams as bytes. The Fortran side is system_file.f90; comments on the arguments are there. */
#define _GNU_SOURCE

#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { is_directory = -1, is_no_file = -2, is_too_large = -3 };

void gudgeon_error_text(int code, char *text, int capacity)
{
   snprintf(text, (size_t)capacity, "%s", strerror(code));
}

/* All bytes up to the end, in memory that the caller gives back with free. */
static int read_to_end(int file, int64_t most, char **bytes, int64_t *n)
{
   int64_t room = 65536;
   char *store = malloc((size_t)room);
   *n = 0;
   while (store != NULL) {
      ssize_t got = read(file, store + *n, (size_t)(room - *n));
      if (got < 0 && errno == EINTR) continue;
      int code = got < 0 ? errno : 0;
      if (got > 0) *n += got;
      if (code == 0 && *n > most) code = is_too_large;
      if (code != 0) {
         free(store);
         return code;
      }
      if (got == 0) {
         *bytes = store;
         return 0;
      }
      if (*n < room) continue;
      room *= 2;
      char *larger = realloc(store, (size_t)room);
      if (larger == NULL) free(store);
      store = larger;
   }
   return ENOMEM;
}

/* Reads a file, or, unless only a regular one will do, whatever can be read to its end. Nothing is waited for before it is
 * known to be wanted: a named pipe is not opened in vain. */
int gudgeon_read_file(const char *path, int only_regular, int64_t most, char **bytes, int64_t *n, int *is_stream)
{
   struct stat status;
   *bytes = NULL;
   *n = 0;
   *is_stream = 0;
   int file = open(path, O_RDONLY | O_CLOEXEC | O_NOCTTY | (only_regular ? O_NONBLOCK : 0));
   if (file < 0) return errno;
   int code = fstat(file, &status) == 0 ? 0 : errno;
   if (code == 0) {
      *is_stream = !S_ISREG(status.st_mode);
      if (S_ISDIR(status.st_mode)) code = is_directory;
      else if (S_ISBLK(status.st_mode) || (*is_stream && only_regular)) code = is_no_file;
      else if (!*is_stream && status.st_size > most) code = is_too_large;
   }
   if (code == is_too_large) *n = status.st_size;
   if (code == 0) code = read_to_end(file, most, bytes, n);
   close(file);
   return code;
}
