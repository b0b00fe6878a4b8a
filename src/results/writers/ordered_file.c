/* A file of HDF5 that can be read whenever its writer dies: a file driver that writes the library's metadata in order.
 *
 * The library writes metadata by address, the length of a dataset before the index of its chunks, and whenever its cache is
 * full: a reader may find rows that were not yet written. Here raw data goes into places that nothing in the file points to, or
 * beyond the length of its dataset, at once where it is long; what is short, and metadata, waits in memory until the library
 * flushes. Then it is written so that nothing points to what is not there:
 *
 *    1. raw data, and blocks that are not yet in the file (nothing points to them): what lies side by side in one write;
 *    2. the superblock, which tells the end of the file;
 *    3. heaps with names, then nodes of B-trees, those nearer to the root first (where a node was parted, its parent knows both
 *       halves while the node itself still holds all), then lists of names;
 *    4. object headers, with the lengths of datasets.
 *
 * The first flush writes the superblock last, so that there is a file or none. What the file points to is changed block by block,
 * each in one write. The system makes a write page by page, and a process that is killed may have made the first pages only: a block
 * that fits into a page never lies in two. Nodes and headers do. Limits: not for power failures, which order nothing; not for a
 * header or heap longer than a page; not where the library, between two flushes, frees a place that the file points to and takes it
 * again (appending rows frees nothing).
 */
#define _GNU_SOURCE

#include <errno.h>
#include <fcntl.h>
#include <hdf5.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

enum { page = 4096 };       /* bytes; where the system's pages are larger they are multiples of it */
enum { short_data = 512 };  /* bytes of raw data that wait; rows of a chunk are more */
enum { most_at_once = 64 }; /* blocks of one write; every system takes as many */
enum { cache_size = 1 << 19 }; /* bytes of metadata that the library keeps, as they lie in the file */

/* What waits. */
typedef struct {
   haddr_t address;
   size_t size;
   H5FD_mem_t type;
   int rank;              /* when it may be written, set by a flush */
   unsigned char *bytes;
} block_t;

typedef struct {
   H5FD_t public;      /* the library's part; must be the first */
   int file;           /* descriptor */
   haddr_t end;        /* end of what the library has given out */
   haddr_t length;     /* of the file */
   block_t *blocks;    /* (n) waiting */
   size_t n, room;
   haddr_t *flushed;   /* (n_flushed) addresses of the metadata in the file, sorted */
   size_t n_flushed, room_flushed;
} ordered_t;

static haddr_t larger(haddr_t a, haddr_t b) { return a > b ? a : b; }
static haddr_t smaller(haddr_t a, haddr_t b) { return a < b ? a : b; }

static herr_t write_all(ordered_t *self, haddr_t address, size_t size, const unsigned char *bytes)
{
   while (size > 0) {
      ssize_t done = pwrite(self->file, bytes, size, (off_t)address);
      if (done < 0 && errno == EINTR) continue;
      if (done <= 0) return -1;
      address += (haddr_t)done;
      bytes += done;
      size -= (size_t)done;
      self->length = larger(self->length, address);
   }
   return 0;
}

/* Blocks that lie side by side, in one write where the system takes it whole. */
static herr_t write_row(ordered_t *self, const block_t *blocks, size_t n)
{
   struct iovec pieces[most_at_once];
   haddr_t address = blocks[0].address;
   size_t size = 0;
   for (size_t k = 0; k < n; k++) {
      pieces[k] = (struct iovec){.iov_base = blocks[k].bytes, .iov_len = blocks[k].size};
      size += blocks[k].size;
   }
   ssize_t done = n > 1 ? pwritev(self->file, pieces, (int)n, (off_t)address) : -1;
   if (done == (ssize_t)size) {
      self->length = larger(self->length, address + size);
      return 0;
   }
   for (size_t k = 0; k < n; k++) {
      if (write_all(self, blocks[k].address, blocks[k].size, blocks[k].bytes) < 0) return -1;
   }
   return 0;
}

static H5FD_t *ordered_open(const char *name, unsigned flags, hid_t access, haddr_t maxaddr)
{
   (void)access, (void)maxaddr;
   int mode = flags & H5F_ACC_RDWR ? O_RDWR : O_RDONLY;
   if (flags & H5F_ACC_TRUNC) mode |= O_TRUNC;
   if (flags & H5F_ACC_CREAT) mode |= O_CREAT;
   if (flags & H5F_ACC_EXCL) mode |= O_EXCL;
   int file = open(name, mode | O_CLOEXEC, 0666);
   if (file < 0) return NULL;
   struct stat status;
   ordered_t *self = fstat(file, &status) == 0 ? calloc(1, sizeof *self) : NULL;
   if (self == NULL) {
      close(file);
      return NULL;
   }
   self->file = file;
   self->length = (haddr_t)status.st_size;
   return &self->public;
}

static herr_t ordered_close(H5FD_t *file)
{
   ordered_t *self = (ordered_t *)file;
   for (size_t k = 0; k < self->n; k++) free(self->blocks[k].bytes);
   free(self->blocks);
   free(self->flushed);
   int code = close(self->file);
   free(self);
   return code == 0 ? 0 : -1;
}

static herr_t ordered_query(const H5FD_t *file, unsigned long *flags)
{
   (void)file;
   /* not: H5FD_FEAT_ACCUMULATE_METADATA, which would join blocks of several kinds; H5FD_FEAT_AGGREGATE_METADATA, which would ask for
      places of several blocks at once */
   *flags = H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_DATA_SIEVE;
   return 0;
}

/* A place at the end for a block; metadata that fits into a page gets one within a page. */
static haddr_t ordered_alloc(H5FD_t *file, H5FD_mem_t type, hid_t transfer, hsize_t size)
{
   (void)transfer;
   ordered_t *self = (ordered_t *)file;
   haddr_t address = self->end;
   if (type != H5FD_MEM_DRAW && size <= page && address % page + size > page) address += page - address % page;
   self->end = address + size;
   return address;
}

static haddr_t ordered_get_eoa(const H5FD_t *file, H5FD_mem_t type)
{
   (void)type;
   return ((const ordered_t *)file)->end;
}

static herr_t ordered_set_eoa(H5FD_t *file, H5FD_mem_t type, haddr_t address)
{
   (void)type;
   ((ordered_t *)file)->end = address;
   return 0;
}

static haddr_t ordered_get_eof(const H5FD_t *file, H5FD_mem_t type)
{
   (void)type;
   return ((const ordered_t *)file)->length;
}

/* Copies what two ranges share, from one's bytes to the other's. */
static void copy_shared(haddr_t from, size_t n_from, const unsigned char *source, haddr_t to, size_t n_to, unsigned char *target)
{
   haddr_t first = larger(from, to), last = smaller(from + n_from, to + n_to);
   if (first < last) memcpy(target + (first - to), source + (first - from), (size_t)(last - first));
}

static herr_t ordered_read(H5FD_t *file, H5FD_mem_t type, hid_t transfer, haddr_t address, size_t size, void *buffer)
{
   (void)type, (void)transfer;
   ordered_t *self = (ordered_t *)file;
   for (size_t done = 0; done < size;) {
      ssize_t got = pread(self->file, (unsigned char *)buffer + done, size - done, (off_t)(address + done));
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) return -1;
      if (got == 0) {
         memset((unsigned char *)buffer + done, 0, size - done);
         break;
      }
      done += (size_t)got;
   }
   for (size_t k = 0; k < self->n; k++) {
      const block_t *block = &self->blocks[k];
      copy_shared(block->address, block->size, block->bytes, address, size, buffer);
   }
   return 0;
}

/* A list with room for one item more, twice as long where it was full; NULL: no memory, the list is as it was. */
static void *with_room(void *list, size_t n, size_t *room, size_t size)
{
   if (n < *room) return list;
   size_t wanted = 2 * *room + 64;
   void *grown = realloc(list, wanted * size);
   if (grown != NULL) *room = wanted;
   return grown;
}

/* Keeps a block until the next flush. */
static herr_t keep_block(ordered_t *self, H5FD_mem_t type, haddr_t address, size_t size, const void *bytes)
{
   block_t *blocks = with_room(self->blocks, self->n, &self->room, sizeof *blocks);
   if (blocks == NULL) return -1;
   self->blocks = blocks;
   block_t block = {address, size, type, 0, malloc(size)};
   if (block.bytes == NULL) return -1;
   memcpy(block.bytes, bytes, size);
   self->blocks[self->n++] = block;
   return 0;
}

static herr_t ordered_write(H5FD_t *file, H5FD_mem_t type, hid_t transfer, haddr_t address, size_t size, const void *buffer)
{
   (void)transfer;
   ordered_t *self = (ordered_t *)file;
   int is_kept = 0;
   for (size_t k = 0; k < self->n; k++) {
      block_t *block = &self->blocks[k];
      copy_shared(address, size, buffer, block->address, block->size, block->bytes);
      if (block->address != address || block->size != size) continue;
      block->type = type;
      is_kept = 1;
   }
   if (is_kept) return 0;
   if (type == H5FD_MEM_DRAW && size > short_data) return write_all(self, address, size, buffer);
   return keep_block(self, type, address, size, buffer);
}

/* How many addresses of metadata in the file are less than this one. */
static size_t flushed_before(const ordered_t *self, haddr_t address)
{
   size_t low = 0, high = self->n_flushed;
   while (low < high) {
      size_t middle = (low + high) / 2;
      if (self->flushed[middle] < address) low = middle + 1;
      else high = middle;
   }
   return low;
}

/* Whether there is metadata in the file at an address; where it has its place in the list. */
static int is_flushed(const ordered_t *self, haddr_t address, size_t *at)
{
   *at = flushed_before(self, address);
   return *at < self->n_flushed && self->flushed[*at] == address;
}

/* Notes that metadata is in the file. */
static herr_t note_flushed(ordered_t *self, haddr_t address)
{
   size_t at;
   if (is_flushed(self, address, &at)) return 0;
   haddr_t *flushed = with_room(self->flushed, self->n_flushed, &self->room_flushed, sizeof *flushed);
   if (flushed == NULL) return -1;
   self->flushed = flushed;
   memmove(self->flushed + at + 1, self->flushed + at, (self->n_flushed - at) * sizeof *self->flushed);
   self->flushed[at] = address;
   self->n_flushed++;
   return 0;
}

enum { rank_new = 1000 };

/* When a block may be written: the least first. In the thousands the steps above, then the place within a step. */
static int rank_block(const ordered_t *self, const block_t *block)
{
   size_t at;
   if (block->type == H5FD_MEM_DRAW) return rank_new;
   int is_there = is_flushed(self, block->address, &at);
   if (block->type == H5FD_MEM_SUPER) return is_there ? 2000 : 5000;
   if (!is_there) return rank_new;
   if (block->type == H5FD_MEM_OHDR) return 4000;
   if (block->type != H5FD_MEM_BTREE) return 3000;
   int is_node = block->size > 5 && memcmp(block->bytes, "TREE", 4) == 0;
   return is_node ? 3500 - block->bytes[5] : 3600;  /* byte 5 of a node: its level above the leaves; below them: lists of names */
}

/* The order in which blocks are written. */
static int compare_blocks(const void *one, const void *other)
{
   const block_t *a = one, *b = other;
   if (a->rank != b->rank) return a->rank < b->rank ? -1 : 1;
   return a->address < b->address ? -1 : a->address > b->address;
}

static herr_t ordered_flush(H5FD_t *file, hid_t transfer, hbool_t closing)
{
   (void)transfer, (void)closing;
   ordered_t *self = (ordered_t *)file;
   for (size_t k = 0; k < self->n; k++) self->blocks[k].rank = rank_block(self, &self->blocks[k]);
   qsort(self->blocks, self->n, sizeof *self->blocks, compare_blocks);
   size_t done = 0;
   herr_t code = 0;
   while (done < self->n) {
      block_t *first = &self->blocks[done];
      size_t n = 1;
      while (first->rank == rank_new && n < most_at_once && done + n < self->n && first[n].rank == rank_new &&
             first[n].address == first[n - 1].address + first[n - 1].size) n++;
      code = write_row(self, first, n);
      for (size_t k = 0; code == 0 && k < n; k++) {
         if (first[k].type != H5FD_MEM_DRAW) code = note_flushed(self, first[k].address);
      }
      if (code != 0) break;
      for (size_t k = 0; k < n; k++) free(first[k].bytes);
      done += n;
   }
   self->n -= done;
   memmove(self->blocks, self->blocks + done, self->n * sizeof *self->blocks);
   return code;
}

static herr_t ordered_truncate(H5FD_t *file, hid_t transfer, hbool_t closing)
{
   (void)transfer, (void)closing;
   ordered_t *self = (ordered_t *)file;
   if (self->end == self->length) return 0;
   if (ftruncate(self->file, (off_t)self->end) != 0) return -1;
   self->length = self->end;
   return 0;
}

static const H5FD_class_t ordered_class = {
#ifdef H5FD_CLASS_VERSION
   .version = H5FD_CLASS_VERSION,
   .value = (H5FD_class_value_t)600,  /* beyond those that are given out */
#endif
   .name = "gudgeon_ordered",
   .maxaddr = HADDR_MAX / 2,
   .fc_degree = H5F_CLOSE_WEAK,
   .open = ordered_open,
   .close = ordered_close,
   .query = ordered_query,
   .alloc = ordered_alloc,
   .get_eoa = ordered_get_eoa,
   .set_eoa = ordered_set_eoa,
   .get_eof = ordered_get_eof,
   .read = ordered_read,
   .write = ordered_write,
   .flush = ordered_flush,
   .truncate = ordered_truncate,
   .fl_map = H5FD_FLMAP_DICHOTOMY,
};

/* Sets, in a list of access properties, a metadata cache that does not grow with the file: rows are appended, and read in their
 * order, so that of an index the last nodes are wanted only. A node takes ten times as much in memory as in the file, by whose
 * size the cache counts. Negative: failed. */
int gudgeon_limit_metadata_cache(hid_t access)
{
   H5AC_cache_config_t cache = {.version = H5AC__CURR_CACHE_CONFIG_VERSION};
   if (H5Pget_mdc_config(access, &cache) < 0) return -1;
   cache.set_initial_size = 1;
   cache.initial_size = cache.min_size = cache.max_size = cache_size;
   cache.incr_mode = H5C_incr__off;
   cache.flash_incr_mode = H5C_flash_incr__off;
   cache.decr_mode = H5C_decr__off;
   return H5Pset_mdc_config(access, &cache) < 0 ? -1 : 0;
}

/* Sets the driver in a list of access properties. Negative: failed. */
int gudgeon_set_ordered_driver(hid_t access)
{
   static hid_t driver = -1;
   if (driver < 0) driver = H5FDregister(&ordered_class);
   if (driver < 0) return -1;
   return H5Pset_driver(access, driver, NULL) < 0 ? -1 : 0;
}
