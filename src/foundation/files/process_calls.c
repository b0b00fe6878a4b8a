/* What the program needs of the operating system to begin, to start other programs and to end them.
 *
 * Every function that can fail returns 0 or an errno value. Nothing here starts a shell.
 * The Fortran side is processes.f90; comments on the arguments are there.
 */
#define _GNU_SOURCE

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif
#ifdef __linux__
#include <sys/mman.h>
#include <sys/prctl.h>
#endif
#include <sys/types.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { max_arguments = 1024, max_groups = 64, longest_wait_ms = 20, grace_ms = 2000, exit_memory = 9, exit_internal = 70,
       short_of_memory = 16777216 };

static volatile sig_atomic_t groups[max_groups]; /* process groups that end with this process; 0: free */

int gudgeon_has_room(int64_t bytes); /* of address_space.c */

extern const char gudgeon_memory_purpose[128]; /* of memory_purpose.f90: what memory is needed for, or blank */

static void say(const char *words)
{
   if (write(2, words, strlen(words)) < 0) _exit(exit_memory);
}

static void end_without_memory(void)
{
   say("error: the memory that this program may use is used up (ulimit -v)");
   if (gudgeon_memory_purpose[0] != '\0') {
      say(", it was needed for ");
      say(gudgeon_memory_purpose);
   }
   say("; what was written before is kept. Give it more, or let the deck keep less.\n");
   _exit(exit_memory);
}

/* The run-time library of Fortran ends a program with 1 if there is no memory, with 2 on a mistake in it: here these are
 * codes of the program's own. */
#ifdef __GLIBC__
static void leave(int code, void *nothing)
{
   (void)nothing;
   if (code == 1) end_without_memory();
   if (code == 2) _exit(exit_internal);
}
#endif

static struct sigaction fault_before;

/* gfortran does not look whether it got the memory for a copy of a structure, nor does a stack that cannot grow say so: an
 * access that fails where memory is used up means just that, and any other is a mistake of the program. */
static void end_of_access(int signal_number)
{
   if (!gudgeon_has_room(short_of_memory)) end_without_memory();
   sigaction(signal_number, &fault_before, NULL);
}

static void watch_memory(void)
{
   static char stack[65536];
   stack_t own = {.ss_sp = stack, .ss_size = sizeof stack};
   struct sigaction action = {.sa_handler = end_of_access, .sa_flags = SA_ONSTACK};
   if (sigaltstack(&own, NULL) == 0) sigaction(SIGSEGV, &action, &fault_before);
}

static const int ends[] = {SIGHUP, SIGINT, SIGTERM}; /* signals that end a program that does not say otherwise */
enum { n_ends = sizeof ends / sizeof ends[0] };

/* A library that comes along with others may take such a signal for purposes of its own as it is loaded (UCX, of MPI, takes
 * SIGHUP), and no kill ends the program then. So what was to become of them is noted before the constructors of the libraries. */
#ifdef __linux__
static struct sigaction given[n_ends];

static void note_signals(void)
{
   for (int k = 0; k < n_ends; k++) sigaction(ends[k], NULL, &given[k]);
}

__attribute__((section(".preinit_array"), used)) static void (*const before_libraries)(void) = note_signals;

static void take_signals_back(void)
{
   for (int k = 0; k < n_ends; k++) sigaction(ends[k], &given[k], NULL);
}
#else
static void take_signals_back(void) {}
#endif

/* Before anything else: descriptors 0 to 2 are open, so that no file of a run gets one of them; a reader that goes away and a
 * file that may not grow are errors of a write, not signals. */
void gudgeon_begin(void)
{
   int file;
   do file = open("/dev/null", O_RDWR);
   while (file >= 0 && file <= 2);
   if (file > 2) close(file);
   take_signals_back();
   signal(SIGPIPE, SIG_IGN);
   signal(SIGXFSZ, SIG_IGN);
#ifdef __GLIBC__
   on_exit(leave, NULL);
#endif
   watch_memory();
}

/* Memory that the smallest run fills anyway, had at once: as it is needed the system hands it out page by page, at more than twice
 * the cost. What is freed stays in the program, up to 64 MB, and arrays up to 32 MB come from the same store, so that pages are
 * used again: the limits that the store of the GNU C library would come to by itself. No promise: where there is no room, or with
 * another library or a sanitizer, whose stores are their own, memory is had as it is needed. */
void gudgeon_take_memory(void)
{
#if defined(__GLIBC__) && defined(MADV_POPULATE_WRITE) && !defined(__SANITIZE_ADDRESS__)
   const size_t whole = (size_t)5 << 19, page = (size_t)sysconf(_SC_PAGESIZE);
   mallopt(M_MMAP_THRESHOLD, 32 << 20);
   mallopt(M_TRIM_THRESHOLD, 64 << 20);
   char *store = malloc(whole);
   if (store == NULL) return;
   uintptr_t first = ((uintptr_t)store + page - 1) / page * page, last = ((uintptr_t)store + whole) / page * page;
   madvise((void *)first, last - first, MADV_POPULATE_WRITE);
   free(store);
#endif
}

#ifdef __SANITIZE_ADDRESS__
int __lsan_do_recoverable_leak_check(void);
#endif

/* Ends the program at once: everything is written, and libraries that tidy up may fail at it (HDF5 does after a failed write).
 * A program with the address sanitizer looks for lost memory here, as it would at an ordinary end. */
void gudgeon_end(int code)
{
#ifdef __SANITIZE_ADDRESS__
   if (__lsan_do_recoverable_leak_check()) _exit(exit_internal);
#endif
   _exit(code);
}

/* A signal that ends this process ends the groups that it started, too. */
static void end_groups(int signal_number)
{
   for (int k = 0; k < max_groups; k++)
      if (groups[k] > 0) kill(-(pid_t)groups[k], SIGKILL);
   signal(signal_number, SIG_DFL);
   raise(signal_number);
}

static void watch_signals(void)
{
   static int is_watching = 0;
   if (is_watching) return;
   is_watching = 1;
   for (int k = 0; k < n_ends; k++) {
      struct sigaction now, action = {.sa_handler = end_groups, .sa_flags = SA_NODEFER};
      if (sigaction(ends[k], NULL, &now) == 0 && now.sa_handler == SIG_DFL) sigaction(ends[k], &action, NULL);
   }
}

/* A child answers signals as programs do by default, but for those that are ignored as nohup wants it, and ends by `death` when
 * the program that made it does. Returns 0, or an errno value if that is gone already. */
int gudgeon_begin_child(int death, pid_t parent)
{
   for (int k = 0; k < max_groups; k++) groups[k] = 0;
   for (int k = 0; k < n_ends; k++) {
      struct sigaction now;
      if (sigaction(ends[k], NULL, &now) == 0 && now.sa_handler == SIG_IGN) continue;
      signal(ends[k], SIG_DFL);
   }
#ifdef __linux__
   prctl(PR_SET_PDEATHSIG, death);
   if (getppid() != parent) return ECHILD;
#else
   (void)death;
   (void)parent;
#endif
   return 0;
}

/* What the child does until it is another program. Returns an errno value if it could not become that. */
static int become(const char *directory, const char *program, char **vector, const char *log, int is_group, pid_t parent)
{
   if (is_group) setpgid(0, 0);
   int code = gudgeon_begin_child(is_group ? SIGKILL : SIGTERM, parent);
   if (code != 0) return code;
   signal(SIGPIPE, SIG_DFL);
   signal(SIGXFSZ, SIG_DFL);
   if (chdir(directory) != 0) return EIO;
   int input = open("/dev/null", O_RDWR | O_CLOEXEC);
   int messages = open(log, O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666);
   if (messages < 0) messages = input;
   if (dup2(input, 0) < 0 || dup2(input, 1) < 0 || dup2(messages, 2) < 0) return errno;
   execvp(program, vector);
   return errno;
}

/* Starts a program in a directory without a shell; its messages go to a file there. The arguments stand one behind the
 * other, each with a null character at its end. ENOENT: not installed. */
int gudgeon_start_program(const char *directory, const char *program, const char *arguments, int n_arguments,
                          const char *log, int is_group, int *process)
{
   char *vector[max_arguments + 2] = {(char *)program};
   if (n_arguments > max_arguments) return E2BIG;
   for (int k = 1; k <= n_arguments; k++) {
      vector[k] = (char *)arguments;
      arguments += strlen(arguments) + 1;
   }
   int report[2];
   if (pipe(report) != 0) return errno;
   fcntl(report[0], F_SETFD, FD_CLOEXEC);
   fcntl(report[1], F_SETFD, FD_CLOEXEC);
   fflush(NULL);
   sigset_t all, before; /* a signal between fork and the entry in the list would leave the child behind */
   sigfillset(&all);
   sigprocmask(SIG_BLOCK, &all, &before);
   if (is_group) watch_signals();
   pid_t parent = getpid(), child = fork();
   int code = child < 0 ? errno : 0;
   if (child == 0) {
      sigprocmask(SIG_SETMASK, &before, NULL);
      code = become(directory, program, vector, log, is_group, parent);
      ssize_t told = write(report[1], &code, sizeof code);
      _exit(told > 0 ? 127 : 126);
   }
   if (child > 0 && is_group) {
      setpgid(child, child);
      for (int k = 0; k < max_groups; k++)
         if (groups[k] == 0) {
            groups[k] = child;
            break;
         }
   }
   sigprocmask(SIG_SETMASK, &before, NULL);
   close(report[1]);
   if (child > 0) {
      ssize_t got;
      do got = read(report[0], &code, sizeof code);
      while (got < 0 && errno == EINTR);
      if (got != (ssize_t)sizeof code) code = 0;
   }
   close(report[0]);
   if (code == 0) *process = (int)child;
   else if (child > 0) waitpid(child, NULL, 0);
   return code;
}

/* 128 + signal if one ended the process. */
int gudgeon_exit_code(int status) { return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status); }

static int64_t now_ms(void)
{
   struct timespec now;
   clock_gettime(CLOCK_MONOTONIC, &now);
   return (int64_t)now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

/* 1: the child has ended, and its status. */
static int has_ended(pid_t child, int *status, int64_t until)
{
   for (int64_t pause = 1;; pause = pause < longest_wait_ms ? 2 * pause : longest_wait_ms) {
      pid_t ended = waitpid(child, status, WNOHANG);
      if (ended == child || (ended < 0 && errno != EINTR)) return 1;
      if (now_ms() >= until) return 0;
      struct timespec wait = {0, 1000000L * (long)pause};
      nanosleep(&wait, NULL);
   }
}

/* Milliseconds on a clock that only goes forward. */
int64_t gudgeon_clock_ms(void) { return now_ms(); }

/* Waits for a program that was started as a group of its own, up to an instant; if it still runs then, it and all that it
 * started are asked to end, and soon are made to. Returns its exit code, 128 + signal if one ended it. */
int gudgeon_wait_group(int process, int64_t until, int *is_late)
{
   int status = 0;
   *is_late = !has_ended((pid_t)process, &status, until);
   if (*is_late) {
      kill(-(pid_t)process, SIGTERM);
      int is_over = has_ended((pid_t)process, &status, now_ms() + grace_ms);
      kill(-(pid_t)process, SIGKILL); /* what it started may have outlived it */
      while (!is_over && waitpid((pid_t)process, &status, 0) < 0 && errno == EINTR) {}
   }
   for (int k = 0; k < max_groups; k++)
      if (groups[k] == process) groups[k] = 0;
   return gudgeon_exit_code(status);
}

static volatile sig_atomic_t asked_by; /* signal that asked this process to end; 0: none did */
static const int asking[] = {SIGHUP, SIGINT, SIGTERM, SIGUSR1};
enum { n_asking = sizeof asking / sizeof asking[0] };

/* The first signal asks, the next one ends. */
static void note_request(int signal_number)
{
   asked_by = signal_number;
   for (int k = 0; k < n_asking; k++) {
      struct sigaction now;
      if (sigaction(asking[k], NULL, &now) == 0 && now.sa_handler == note_request) signal(asking[k], SIG_DFL);
   }
}

/* From here on a signal that would end the process asks it to end, `gudgeon_asked_by` tells which; or no longer. */
void gudgeon_listen(int is_on)
{
   struct sigaction now, action = {.sa_handler = note_request, .sa_flags = SA_RESTART};
   if (is_on) asked_by = 0;
   for (int k = 0; k < n_asking; k++) {
      if (sigaction(asking[k], NULL, &now) != 0) continue;
      if (is_on && now.sa_handler == SIG_DFL) sigaction(asking[k], &action, NULL);
      if (!is_on && now.sa_handler == note_request) signal(asking[k], SIG_DFL);
   }
}

/* The signal that asked, 0: none. */
int gudgeon_asked_by(void) { return (int)asked_by; }

/* Ends this process by the signal that asked. */
void gudgeon_end_by(int signal_number)
{
   signal(signal_number, SIG_DFL);
   raise(signal_number);
}
