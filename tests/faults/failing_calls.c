// A library to preload: the n-th call of one kind fails, or the power fails at it.
//
//   SHOAL_FAULT=KIND:N    fails the N-th call of a kind in each process: open, read, write, sync,
//                         rename, truncate, folder, memory
//   SHOAL_FAULT=power:N   at the N-th call that changes a file, every process of the group is
//   killed SHOAL_FAULT_COUNTS=F  when a process ends, the number of calls of each kind is added to
//   file F SHOAL_FAULT_SYNCED=D  what is synced is copied to folder D, under the number of its
//   inode

#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

enum kind { OPEN, READ, WRITE, SYNC, RENAME, TRUNCATE, FOLDER, MEMORY, POWER, KINDS };
static const char* const names[KINDS] = {"open",     "read",   "write",  "sync", "rename",
                                         "truncate", "folder", "memory", "power"};
static atomic_long calls[KINDS];
static enum kind wanted = KINDS;
static long nth = -1;
static const char* synced_folder;

extern void* __libc_malloc(size_t size);
extern void* __libc_calloc(size_t count, size_t size);
extern void* __libc_realloc(void* old, size_t size);

__attribute__((constructor)) static void begin(void) {
  const char* fault = getenv("SHOAL_FAULT");
  synced_folder = getenv("SHOAL_FAULT_SYNCED");
  if (fault == NULL) return;
  for (int k = 0; k < KINDS; ++k) {
    const size_t length = strlen(names[k]);
    if (strncmp(fault, names[k], length) != 0 || fault[length] != ':') continue;
    wanted = (enum kind)k;
    nth = atol(fault + length + 1);
  }
}

__attribute__((destructor)) static void end(void) {
  const char* file = getenv("SHOAL_FAULT_COUNTS");
  if (file == NULL) return;
  char text[400];
  int length = 0;
  for (int k = 0; k < KINDS; ++k) {
    length += snprintf(text + length, sizeof text - (size_t)length, "%s %ld\n", names[k],
                       atomic_load(&calls[k]));
  }
  const int to = (int)syscall(SYS_openat, AT_FDCWD, file, O_WRONLY | O_CREAT | O_APPEND, 0644);
  if (to < 0) return;
  syscall(SYS_write, to, text, (size_t)length);
  syscall(SYS_close, to);
}

// Whether this call is the one that fails. Later ones succeed again.
static int fails(enum kind kind) {
  return atomic_fetch_add(&calls[kind], 1) + 1 == nth && kind == wanted;
}

static void change(void) {
  if (fails(POWER)) kill(0, SIGKILL);
}

#define NEXT(name)               \
  static __typeof__(name)* next; \
  if (next == NULL) next = (__typeof__(name)*)dlsym(RTLD_NEXT, #name)

static int no_space(enum kind kind) {
  if (!fails(kind)) return 0;
  errno = kind == READ || kind == SYNC ? EIO : kind == OPEN ? EMFILE : ENOSPC;
  return 1;
}

// ---- opening ----

#define OPENING(name, before, arguments)         \
  int name before {                              \
    NEXT(name);                                  \
    mode_t mode = 0;                             \
    if (flags & (O_CREAT | __O_TMPFILE)) {       \
      va_list rest;                              \
      va_start(rest, flags);                     \
      mode = va_arg(rest, mode_t);               \
      va_end(rest);                              \
    }                                            \
    return no_space(OPEN) ? -1 : next arguments; \
  }
OPENING(open, (const char* path, int flags, ...), (path, flags, mode))
OPENING(open64, (const char* path, int flags, ...), (path, flags, mode))
OPENING(openat, (int at, const char* path, int flags, ...), (at, path, flags, mode))
OPENING(openat64, (int at, const char* path, int flags, ...), (at, path, flags, mode))

FILE* fopen(const char* path, const char* mode) {
  NEXT(fopen);
  return no_space(OPEN) ? NULL : next(path, mode);
}
FILE* fopen64(const char* path, const char* mode) {
  NEXT(fopen64);
  return no_space(OPEN) ? NULL : next(path, mode);
}

// ---- reading and writing ----

ssize_t read(int file, void* to, size_t size) {
  NEXT(read);
  return no_space(READ) ? -1 : next(file, to, size);
}
ssize_t pread(int file, void* to, size_t size, off_t at) {
  NEXT(pread);
  return no_space(READ) ? -1 : next(file, to, size, at);
}
ssize_t pread64(int file, void* to, size_t size, off64_t at) {
  NEXT(pread64);
  return no_space(READ) ? -1 : next(file, to, size, at);
}
ssize_t write(int file, const void* from, size_t size) {
  NEXT(write);
  change();
  return no_space(WRITE) ? -1 : next(file, from, size);
}
ssize_t writev(int file, const struct iovec* from, int count) {
  NEXT(writev);
  change();
  return no_space(WRITE) ? -1 : next(file, from, count);
}
ssize_t pwrite(int file, const void* from, size_t size, off_t at) {
  NEXT(pwrite);
  change();
  return no_space(WRITE) ? -1 : next(file, from, size, at);
}
ssize_t pwrite64(int file, const void* from, size_t size, off64_t at) {
  NEXT(pwrite64);
  change();
  return no_space(WRITE) ? -1 : next(file, from, size, at);
}

size_t fwrite(const void* from, size_t size, size_t count, FILE* file) {
  NEXT(fwrite);
  change();
  return no_space(WRITE) ? 0 : next(from, size, count, file);
}
int fflush(FILE* file) {
  NEXT(fflush);
  change();
  return no_space(WRITE) ? EOF : next(file);
}
int fclose(FILE* file) {
  NEXT(fclose);
  change();
  const int failed = no_space(WRITE);
  const int result = next(file);
  if (!failed) return result;
  errno = ENOSPC;
  return EOF;
}

// ---- what makes it last ----

static void keep(int file) {
  struct stat status;
  if (synced_folder == NULL || fstat(file, &status) != 0 || !S_ISREG(status.st_mode)) return;
  char from_name[64], name[4000], part[4096];
  snprintf(from_name, sizeof from_name, "/proc/self/fd/%d", file);
  snprintf(name, sizeof name, "%s/%lu", synced_folder, (unsigned long)status.st_ino);
  snprintf(part, sizeof part, "%s.part", name);
  const int from = (int)syscall(SYS_openat, AT_FDCWD, from_name, O_RDONLY, 0);
  const int to = (int)syscall(SYS_openat, AT_FDCWD, part, O_WRONLY | O_CREAT | O_TRUNC, 0644);
  off_t at = 0;
  while (from >= 0 && to >= 0 && at < status.st_size) {
    if (sendfile(to, from, &at, (size_t)(status.st_size - at)) <= 0) break;
  }
  syscall(SYS_close, from);
  syscall(SYS_close, to);
  syscall(SYS_rename, part, name);
}

#define SYNCING(name)              \
  int name(int file) {             \
    NEXT(name);                    \
    change();                      \
    if (no_space(SYNC)) return -1; \
    const int result = next(file); \
    keep(file);                    \
    return result;                 \
  }
SYNCING(fsync)
SYNCING(fdatasync)

int rename(const char* from, const char* to) {
  NEXT(rename);
  change();
  return no_space(RENAME) ? -1 : next(from, to);
}
int unlink(const char* path) {
  NEXT(unlink);
  change();
  return next(path);
}
#define TRUNCATING(name, offset)                       \
  int name(int file, offset size) {                    \
    NEXT(name);                                        \
    change();                                          \
    return no_space(TRUNCATE) ? -1 : next(file, size); \
  }
TRUNCATING(ftruncate, off_t)
TRUNCATING(ftruncate64, off64_t)

int mkdir(const char* path, mode_t mode) {
  NEXT(mkdir);
  change();
  return no_space(FOLDER) ? -1 : next(path, mode);
}

// ---- memory ----

void* malloc(size_t size) {
  if (fails(MEMORY)) return errno = ENOMEM, NULL;
  return __libc_malloc(size);
}
void* calloc(size_t count, size_t size) {
  if (fails(MEMORY)) return errno = ENOMEM, NULL;
  return __libc_calloc(count, size);
}
void* realloc(void* old, size_t size) {
  if (fails(MEMORY)) return errno = ENOMEM, NULL;
  return __libc_realloc(old, size);
}
