/* What the writers need of the operating system: directories, locks, whole writes, another program.
 *
 * Every function that can fail returns 0 or an errno value. Nothing here starts a shell.
 * The Fortran side is posix.f90; comments on the arguments are there.
 */
#define _GNU_SOURCE

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <limits.h>
#include <math.h>
#include <sched.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif
#include <sys/stat.h>
#include <sys/types.h>
#include <sys/wait.h>
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

/* 1: nothing in the directory; 0: something, or it cannot be read. */
int gudgeon_is_empty_directory(const char *path)
{
   DIR *directory = opendir(path);
   if (directory == NULL) return 0;
   int empty = 1;
   for (struct dirent *entry = readdir(directory); entry != NULL && empty; entry = readdir(directory))
      if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0) empty = 0;
   closedir(directory);
   return empty;
}

static int remove_visited(const char *path, const struct stat *status, int type, struct FTW *place)
{
   (void)status;
   (void)type;
   (void)place;
   return remove(path) == 0 ? 0 : errno;
}

/* Removes a directory with all it holds; links are removed, not followed. */
int gudgeon_remove_tree(const char *path)
{
   int code = nftw(path, remove_visited, 16, FTW_DEPTH | FTW_PHYS | FTW_MOUNT);
   return code == -1 ? errno : code;
}

int gudgeon_remove_file(const char *path) { return unlink(path) == 0 ? 0 : errno; }

int gudgeon_rename(const char *from, const char *to) { return rename(from, to) == 0 ? 0 : errno; }

/* Takes the lock of a file, which is made if need be. EWOULDBLOCK: a living process holds it. */
int gudgeon_lock(const char *path, int *file, int64_t *holder)
{
   *holder = 0;
   for (int attempt = 0; attempt < 100; attempt++) {
      int fd = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
      if (fd < 0) return errno;
      if (flock(fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
         char digits[32] = "";
         if (read(fd, digits, sizeof digits - 1) > 0) *holder = strtoll(digits, NULL, 10);
         close(fd);
         return EWOULDBLOCK;
      } /* where the file system knows no locks, go on without */
      struct stat held, named;
      if (fstat(fd, &held) == 0 && stat(path, &named) == 0 && held.st_ino == named.st_ino) {
         char digits[32];
         int n = snprintf(digits, sizeof digits, "%lld\n", (long long)getpid());
         if (ftruncate(fd, 0) != 0 || write(fd, digits, (size_t)n) != n) n = 0; /* only for the message */
         *file = fd;
         return 0;
      }
      close(fd); /* its last owner has just removed it: once more */
   }
   return EAGAIN;
}

void gudgeon_unlock(const char *path, int file)
{
   unlink(path);
   close(file);
}

/* Writes all of the bytes at an offset, which becomes the end if it fails: never half a record. */
int gudgeon_write_at(const char *path, const char *bytes, int64_t n, int64_t offset)
{
   int fd = open(path, O_WRONLY | O_CREAT | O_CLOEXEC | (offset == 0 ? O_TRUNC : 0), 0666);
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

/* Reserves space behind the end of a file, so that what is written there next cannot lack it. */
int gudgeon_reserve(const char *path, int64_t n)
{
#ifdef __linux__
   int fd = open(path, O_WRONLY | O_CLOEXEC);
   if (fd < 0) return errno;
   struct stat status;
   int code = 0;
   if (fstat(fd, &status) != 0 || fallocate(fd, FALLOC_FL_KEEP_SIZE, status.st_size, (off_t)n) != 0) code = errno;
   close(fd);
   return code == ENOSPC || code == EDQUOT || code == EFBIG ? code : 0; /* some file systems cannot reserve */
#else
   (void)path;
   (void)n;
   return 0;
#endif
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

void gudgeon_error_text(int code, char *text, int capacity)
{
   snprintf(text, (size_t)capacity, "%s", strerror(code));
}

void gudgeon_host_name(char *name, int capacity)
{
   if (gethostname(name, (size_t)capacity) != 0) name[0] = '\0';
   name[capacity - 1] = '\0';
}

enum { max_arguments = 1024 };

/* Starts a program in a directory without a shell; its messages go to a file there. The arguments stand one behind the
 * other, each with a null character at its end. ENOENT: not installed. */
int gudgeon_start_program(const char *directory, const char *program, const char *arguments, int n_arguments,
                          const char *log, int *process)
{
   char *vector[max_arguments + 2] = {(char *)program};
   if (n_arguments > max_arguments) return E2BIG;
   for (int k = 1; k <= n_arguments; k++) {
      vector[k] = (char *)arguments;
      arguments += strlen(arguments) + 1;
   }
   int report[2];
   if (pipe(report) != 0) return errno;
   fcntl(report[1], F_SETFD, FD_CLOEXEC);
   fflush(NULL);
   pid_t child = fork();
   if (child < 0) {
      int code = errno;
      close(report[0]);
      close(report[1]);
      return code;
   }
   if (child == 0) {
      int code = 0;
      close(report[0]);
#ifdef __linux__
      prctl(PR_SET_PDEATHSIG, SIGTERM); /* it ends with the program that asked for it */
#endif
      if (chdir(directory) != 0) code = EIO;
      int input = open("/dev/null", O_RDWR);
      int messages = open(log, O_WRONLY | O_CREAT | O_TRUNC, 0666);
      if (messages < 0) messages = input;
      if (code == 0 && dup2(input, 0) >= 0 && dup2(input, 1) >= 0 && dup2(messages, 2) >= 0)
         execvp(program, vector);
      if (code == 0) code = errno;
      ssize_t told = write(report[1], &code, sizeof code);
      _exit(told > 0 ? 127 : 126);
   }
   close(report[1]);
   int code = 0;
   ssize_t got;
   do got = read(report[0], &code, sizeof code);
   while (got < 0 && errno == EINTR);
   close(report[0]);
   if (got == (ssize_t)sizeof code) {
      waitpid(child, NULL, 0);
      return code;
   }
   *process = (int)child;
   return 0;
}

/* Waits for whichever program ends next; its number, and its exit code as below. 0: none is running. */
int gudgeon_wait_any(int *code)
{
   int status = 0;
   pid_t child;
   do child = waitpid(-1, &status, 0);
   while (child < 0 && errno == EINTR);
   if (child < 0) return 0;
   *code = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
   return (int)child;
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

/* Waits for a program that was started; returns its exit code, 128 + signal if one ended it. */
int gudgeon_wait_program(int process)
{
   int status = 0;
   while (waitpid((pid_t)process, &status, 0) < 0)
      if (errno != EINTR) return 128;
   if (WIFSIGNALED(status)) return 128 + WTERMSIG(status);
   return WEXITSTATUS(status);
}
