/* What the writers need of the operating system: directories, locks, whole writes.
 *
 * Every function that can fail returns 0 or an errno value.
 * The Fortran side is posix.f90; comments on the arguments are there.
 */
#define _GNU_SOURCE

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <sys/types.h>
#include <time.h>
#include <unistd.h>

enum { kind_none = 0, kind_directory = 1, kind_other = 2 };

/* What a path names; links are followed. */
int gudgeon_path_kind(const char *path)
{
   struct stat status;
   if (stat(path, &status) != 0) return kind_none;
   return S_ISDIR(status.st_mode) ? kind_directory : kind_other;
}

/* 1: the path names a symbolic link, whether it leads anywhere or not. */
int gudgeon_is_link(const char *path)
{
   struct stat status;
   return lstat(path, &status) == 0 && S_ISLNK(status.st_mode);
}

/* Makes one directory; that it is there already is no failure. */
static int make_one(const char *path)
{
   if (mkdir(path, 0777) == 0) return 0;
   int code = errno;
   if (gudgeon_path_kind(path) == kind_directory) return 0;
   return code == EEXIST ? ENOTDIR : code;
}

/* Makes a directory and those above it. */
int gudgeon_make_directory(const char *path)
{
   if (make_one(path) == 0) return 0; /* most often all above it is there */
   char *copy = strdup(path);
   if (copy == NULL) return ENOMEM;
   int code = 0;
   for (char *at = copy + 1; code == 0 && *at != '\0'; at++) {
      if (*at != '/') continue;
      *at = '\0';
      code = make_one(copy);
      *at = '/';
   }
   if (code == 0) code = make_one(copy);
   free(copy);
   return code;
}

/* The path without links and dots; the path itself if it does not exist. */
void gudgeon_real_path(const char *path, char *real, int capacity)
{
   char *found = realpath(path, NULL);
   snprintf(real, (size_t)capacity, "%s", found != NULL ? found : path);
   free(found);
}

int gudgeon_remove_file(const char *path) { return unlink(path) == 0 ? 0 : errno; }

int gudgeon_rename(const char *from, const char *to) { return rename(from, to) == 0 ? 0 : errno; }

/* Opens a file within a directory without following any link on the way to it. The last part of the path is left for the
 * caller: returns the open directory that holds it, or -1. */
static int open_holder(const char *directory, const char *path, const char **last)
{
   int at = open(directory, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
   while (at >= 0) {
      const char *slash = strchr(path, '/');
      if (slash == NULL || slash[1] == '\0') break;
      char *part = strndup(path, (size_t)(slash - path));
      int next = part != NULL ? openat(at, part, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC) : -1;
      int code = errno;
      free(part);
      close(at);
      errno = code;
      at = next;
      path = slash + 1;
   }
   *last = path;
   return at;
}

/* Removes what a path within a directory names: a file or link, or, with a slash at the end, an empty directory. */
int gudgeon_remove_within(const char *directory, const char *path)
{
   const char *last;
   int at = open_holder(directory, path, &last);
   if (at < 0) return errno;
   char *name = strdup(last);
   int code = name != NULL ? 0 : ENOMEM;
   if (code == 0) {
      size_t n = strlen(name);
      int is_directory = n > 0 && name[n - 1] == '/';
      if (is_directory) name[n - 1] = '\0';
      if (unlinkat(at, name, is_directory ? AT_REMOVEDIR : 0) != 0) code = errno;
   }
   free(name);
   close(at);
   return code;
}

/* The names in a directory, one behind the other, each with a null character at its end, those of directories with a slash
 * before it; links are not followed. What they need is counted even if there is no room for it. */
int gudgeon_list(const char *directory, char *names, int64_t capacity, int64_t *n)
{
   *n = 0;
   int at = open(directory, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
   DIR *stream = at >= 0 ? fdopendir(at) : NULL;
   if (stream == NULL) {
      int code = errno;
      if (at >= 0) close(at);
      return code;
   }
   int code = 0;
   for (;;) {
      errno = 0;
      struct dirent *entry = readdir(stream);
      if (entry == NULL) {
         code = errno;
         break;
      }
      if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0) continue;
      struct stat status;
      int is_directory = fstatat(at, entry->d_name, &status, AT_SYMLINK_NOFOLLOW) == 0 && S_ISDIR(status.st_mode);
      int64_t length = (int64_t)strlen(entry->d_name);
      if (*n + length + 2 <= capacity) {
         memcpy(names + *n, entry->d_name, (size_t)length);
         memcpy(names + *n + length, is_directory ? "/" : "", is_directory ? 2 : 1);
      }
      *n += length + 1 + is_directory;
   }
   closedir(stream);
   return code;
}

/* Opens a file and locks it as long as it is open; a link is not followed, nothing is changed in it. `make`: it is made if
 * there is none. EWOULDBLOCK: another process holds the lock. `is_locked` is 0 where the file system knows no locks. */
int gudgeon_lock(const char *path, int make, int *file, int *is_locked)
{
   const int flags = O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC;
   for (int attempt = 0; attempt < 100; attempt++) {
      int fd = open(path, flags);
      if (fd < 0 && errno == ENOENT && make) {
         fd = open(path, flags | O_CREAT | O_EXCL, 0666);
         if (fd < 0 && errno == EEXIST) continue;
      }
      if (fd < 0) return errno;
      struct stat held, named;
      int code = fstat(fd, &held) == 0 ? 0 : errno;
      if (code == 0 && !S_ISREG(held.st_mode)) code = EINVAL;
      int result = 0;
      if (code == 0) {
         do result = flock(fd, LOCK_EX | LOCK_NB);
         while (result != 0 && errno == EINTR);
         if (result != 0 && errno == EWOULDBLOCK) code = EWOULDBLOCK;
      }
      if (code != 0) {
         close(fd);
         return code;
      }
      *is_locked = result == 0;
      if (lstat(path, &named) == 0 && held.st_ino == named.st_ino && held.st_dev == named.st_dev) {
         *file = fd;
         return 0;
      }
      close(fd); /* its last owner has just taken it away: once more */
   }
   return EAGAIN;
}

void gudgeon_close(int file) { close(file); }

/* 1: a process of this number lives on this machine. */
int gudgeon_is_alive(int64_t process) { return kill((pid_t)process, 0) == 0 || errno == EPERM; }

/* Hands what was written to a file, or the names in a directory, to the disk; file systems that cannot are passed over. */
int gudgeon_sync(const char *path)
{
   int fd = open(path, O_RDONLY | O_CLOEXEC);
   if (fd < 0) return errno;
   int code = fsync(fd) == 0 ? 0 : errno;
   close(fd);
   return code == EIO || code == ENOSPC || code == EDQUOT ? code : 0;
}

/* Bytes that nobody can guess. */
void gudgeon_random(unsigned char *bytes, int n)
{
   int fd = open("/dev/urandom", O_RDONLY | O_CLOEXEC);
   ssize_t got = fd >= 0 ? read(fd, bytes, (size_t)n) : 0;
   if (fd >= 0) close(fd);
   struct timespec now;
   clock_gettime(CLOCK_REALTIME, &now);
   uint64_t state = (uint64_t)now.tv_nsec * 1000003u ^ (uint64_t)now.tv_sec << 20 ^ (uint64_t)getpid() << 44;
   for (int k = got > 0 ? (int)got : 0; k < n; k++) {
      state = state * 6364136223846793005u + 1442695040888963407u;
      bytes[k] = (unsigned char)(state >> 56);
   }
}

/* Writes all of the bytes at an offset, which becomes the end if it fails: never half a record. */
int gudgeon_write_at(const char *path, const char *bytes, int64_t n, int64_t offset)
{
   int fd = open(path, O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW | (offset == 0 ? O_TRUNC : 0), 0666);
   if (fd < 0) return errno;
   int code = 0;
   for (int64_t done = 0; done < n && code == 0;) {
      ssize_t written = pwrite(fd, bytes + done, (size_t)(n - done), (off_t)(offset + done));
      if (written > 0) done += written;
      else if (written == 0) code = ENOSPC;
      else if (errno != EINTR) code = errno;
   }
   if (code != 0 && ftruncate(fd, (off_t)offset) != 0) errno = code;
   if (close(fd) != 0 && code == 0) code = errno;
   return code;
}

/* Writes all of the bytes to an open descriptor. */
int gudgeon_write_open(int file, const char *bytes, int64_t n)
{
   for (int64_t done = 0; done < n;) {
      ssize_t written = write(file, bytes + done, (size_t)(n - done));
      if (written > 0) done += written;
      else if (written == 0) return ENOSPC;
      else if (errno != EINTR) return errno;
   }
   return 0;
}

/* Reserves space behind the end of a file, so that what is written there next cannot lack it. The limit of the size of a file
   (ulimit -f) is looked at here: no bytes beyond the end are counted against it. */
int gudgeon_reserve(const char *path, int64_t n)
{
#ifdef __linux__
   int fd = open(path, O_WRONLY | O_CLOEXEC);
   if (fd < 0) return errno;
   struct stat status;
   struct rlimit limit;
   int code = 0;
   if (fstat(fd, &status) == 0 && getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY
       && (rlim_t)status.st_size + (rlim_t)n > limit.rlim_cur) code = EFBIG;
   else if (fstat(fd, &status) != 0 || fallocate(fd, FALLOC_FL_KEEP_SIZE, status.st_size, (off_t)n) != 0) code = errno;
   close(fd);
   return code == ENOSPC || code == EDQUOT || code == EFBIG ? code : 0; /* some file systems cannot reserve */
#else
   (void)path;
   (void)n;
   return 0;
#endif
}

/* Cuts a file off at a length that it must have. */
int gudgeon_cut(const char *path, int64_t length)
{
   struct stat status;
   if (stat(path, &status) != 0) return errno;
   if (status.st_size < (off_t)length) return ENODATA;
   return truncate(path, (off_t)length) == 0 ? 0 : errno;
}

/* Bytes that are free where a path is, for this user; -1: not known. */
int64_t gudgeon_free_space(const char *path)
{
   struct statvfs space;
   if (statvfs(path, &space) != 0) return -1;
   return (int64_t)space.f_bavail * (int64_t)space.f_frsize;
}

/* Gives back what was reserved behind the end of a file and not used. */
void gudgeon_release(const char *path)
{
   struct stat status;
   if (stat(path, &status) != 0 || truncate(path, status.st_size + 1) != 0) return;
   if (truncate(path, status.st_size) != 0) return;
}

/* Date and time of the world, as 2026-01-31T23:59:59Z. */
void gudgeon_utc_time(char *text, int capacity)
{
   time_t now = time(NULL);
   struct tm parts;
   text[0] = '\0';
   if (gmtime_r(&now, &parts) != NULL) strftime(text, (size_t)capacity, "%Y-%m-%dT%H:%M:%SZ", &parts);
}

void gudgeon_host_name(char *name, int capacity)
{
   if (gethostname(name, (size_t)capacity) != 0) name[0] = '\0';
   name[capacity - 1] = '\0';
}

/* Processors that this process may use. */
int gudgeon_processors(void)
{
#ifdef __linux__
   cpu_set_t set;
   if (sched_getaffinity(0, sizeof set, &set) == 0) return CPU_COUNT(&set);
#endif
   long n = sysconf(_SC_NPROCESSORS_ONLN);
   return n > 0 ? (int)n : 1;
}

/* The file that this process runs; empty where the system does not tell. */
void gudgeon_own_path(char *path, int capacity)
{
   ssize_t n = readlink("/proc/self/exe", path, (size_t)capacity - 1);
   path[n > 0 ? n : 0] = '\0';
}
