/* Members: copies of this process that work on a task of their own and hand back what they found as bytes.
 *
 * A copy has all that was read and built before, so that it begins at once; what it does to its memory, and its end, do not touch
 * this process. The Fortran side is members.f90; comments on the arguments are there.
 */
#define _GNU_SOURCE

#include <elf.h>
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

enum { most_members = 1024, first_room = 65536 };

struct member {
   pid_t process; /* 0: free */
   int pipe;      /* what it hands back comes out here */
   char *bytes;   /* what came so far */
   size_t n, room;
};

static struct member members[most_members];
static int way_back = -1; /* in a member: where what it found goes */

int gudgeon_begin_child(int death, pid_t parent); /* of process_calls.c */
int gudgeon_exit_code(int status);
int gudgeon_write_open(int file, const char *bytes, int64_t n); /* of posix_calls.c */

/* What a copy does first: it lets go of what is the parent's. */
static int begin(const char *log, pid_t parent)
{
   for (int k = 0; k < most_members; k++) {
      if (members[k].process == 0) continue;
      close(members[k].pipe);
      free(members[k].bytes);
      members[k].process = 0;
   }
   int code = gudgeon_begin_child(SIGKILL, parent);
   if (code != 0) return code;
   int input = open("/dev/null", O_RDWR | O_CLOEXEC);
   int messages = open(log, O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666);
   if (messages < 0) return errno;
   if (dup2(input, 0) < 0 || dup2(input, 1) < 0 || dup2(messages, 2) < 0) return errno;
   close(input);
   close(messages);
   return 0;
}

/* Starts a member; its messages go to a file. In the copy the number is 0. */
int gudgeon_start_member(const char *log, int *process)
{
   int at = 0;
   while (at < most_members && members[at].process != 0) at++;
   if (at == most_members) return EAGAIN;
   int ends[2];
   if (pipe(ends) != 0) return errno;
   fcntl(ends[0], F_SETFD, FD_CLOEXEC);
   fcntl(ends[1], F_SETFD, FD_CLOEXEC);
   fflush(NULL);
   pid_t parent = getpid(), child = fork();
   if (child < 0) {
      int code = errno;
      close(ends[0]);
      close(ends[1]);
      return code;
   }
   *process = (int)child;
   if (child == 0) {
      close(ends[0]);
      way_back = ends[1];
      return begin(log, parent);
   }
   close(ends[1]);
   members[at] = (struct member){.process = child, .pipe = ends[0]};
   return 0;
}

/* In a member: hands bytes back. */
int gudgeon_hand_back(const char *bytes, int64_t n) { return gudgeon_write_open(way_back, bytes, n); }

/* Takes what can be had from a member. 0: it has nothing more to say. */
static int take(struct member *member)
{
   if (member->room - member->n < first_room) {
      size_t room = member->room == 0 ? 2 * first_room : 2 * member->room;
      char *larger = realloc(member->bytes, room);
      if (larger == NULL) return 0; /* the record is then cut off, which its reader finds */
      member->bytes = larger;
      member->room = room;
   }
   ssize_t got = read(member->pipe, member->bytes + member->n, member->room - member->n);
   if (got < 0) return errno == EINTR || errno == EAGAIN;
   member->n += (size_t)got;
   return got > 0;
}

/* Waits for whichever member ends next: its number, its exit code, and what it handed back, which the caller frees. 0: none runs. */
int gudgeon_next_member(int *code, char **bytes, int64_t *n)
{
   struct pollfd waiting[most_members];
   int which[most_members], running;
   for (;;) {
      running = 0;
      for (int k = 0; k < most_members; k++) {
         if (members[k].process == 0) continue;
         waiting[running] = (struct pollfd){.fd = members[k].pipe, .events = POLLIN};
         which[running++] = k;
      }
      if (running == 0) return 0;
      if (poll(waiting, (nfds_t)running, -1) < 0) continue;
      for (int k = 0; k < running; k++) {
         struct member *member = &members[which[k]];
         if (waiting[k].revents == 0 || take(member)) continue;
         int status = 0, process = (int)member->process;
         close(member->pipe);
         while (waitpid(member->process, &status, 0) < 0 && errno == EINTR) {}
         *code = gudgeon_exit_code(status);
         *bytes = member->bytes;
         *n = (int64_t)member->n;
         *member = (struct member){0};
         return process;
      }
   }
}

static double seconds(int who)
{
   struct rusage usage;
   getrusage(who, &usage);
   return (double)(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) + 1e-6 * (double)(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

/* Processor time of this process and of all that it waited for [s]. */
double gudgeon_cpu_of_all(void) { return seconds(RUSAGE_SELF) + seconds(RUSAGE_CHILDREN); }

/* By what a file is known to be the same: which one it is, its size, when it was written. Empty: there is none. */
void gudgeon_stamp(const char *path, char *text, int capacity)
{
   struct stat status;
   text[0] = '\0';
   if (stat(path, &status) == 0)
      snprintf(text, (size_t)capacity, "%lld bytes of %lld.%09ld", (long long)status.st_size, (long long)status.st_mtime,
               status.st_mtim.tv_nsec);
}

#ifdef __GLIBC__
#include <link.h>

struct identity {
   char *text;
   int capacity;
};

static int look_at(struct dl_phdr_info *object, size_t size, void *result)
{
   (void)size;
   struct identity *identity = result;
   for (int k = 0; k < object->dlpi_phnum; k++) {
      if (object->dlpi_phdr[k].p_type != PT_NOTE) continue;
      const char *at = (const char *)(object->dlpi_addr + object->dlpi_phdr[k].p_vaddr), *end = at + object->dlpi_phdr[k].p_memsz;
      while (at + sizeof(ElfW(Nhdr)) <= end) {
         const ElfW(Nhdr) *note = (const ElfW(Nhdr) *)at;
         const char *name = at + sizeof *note, *id = name + ((note->n_namesz + 3) & ~3U);
         if (note->n_type == NT_GNU_BUILD_ID && note->n_namesz == 4 && memcmp(name, "GNU", 4) == 0) {
            for (unsigned b = 0; b < note->n_descsz && (int)(2 * b + 2) < identity->capacity; b++)
               snprintf(identity->text + (size_t)2 * b, 3, "%02x", (unsigned char)id[b]);
            return 1;
         }
         at = id + ((note->n_descsz + 3) & ~3U);
      }
   }
   return 1; /* the program is the first of all objects */
}

/* What the linker made of the content of this program; empty where it does not. */
void gudgeon_build_id(char *text, int capacity)
{
   struct identity identity = {text, capacity};
   text[0] = '\0';
   dl_iterate_phdr(look_at, &identity);
}
#else
void gudgeon_build_id(char *text, int capacity)
{
   (void)capacity;
   text[0] = '\0';
}
#endif
