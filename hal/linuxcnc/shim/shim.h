/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * What the components of this folder share: the memory between them and the program twin, the
 * question and its answer. See ../segment.h for both.
 */
#ifndef TWIN_SHIM_H
#define TWIN_SHIM_H

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <linux/futex.h>
#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/fsuid.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include "hal.h"
#include "rtapi.h"
#include "rtapi_app.h"

#include "../segment.h"

#define SHIM_ERROR(...) rtapi_print_msg(RTAPI_MSG_ERR, __VA_ARGS__)
#define SHIM_SLICE_NS 50000000LL /* between two looks whether the other side lives */

struct shim {
  struct twin_segment* segment;
  int file;
  char name[64];         /* of the memory */
  const char* component; /* for messages */
};

static int64_t shim_now(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (int64_t)now.tv_sec * 1000000000LL + now.tv_nsec;
}

/* The user that files belong to which this thread makes: rtapi_app is another one than it seems. */
static uid_t shim_user(void) { return (uid_t)setfsuid((uid_t)-1); }

static int shim_lock(int file, int byte, int command, struct flock* lock) {
  memset(lock, 0, sizeof *lock);
  lock->l_type = F_WRLCK;
  lock->l_whence = SEEK_SET;
  lock->l_start = byte;
  lock->l_len = 1;
  return fcntl(file, command, lock);
}

/* Whether the program holds its byte: it lives. */
static int shim_has_program(const struct shim* shim) {
  struct flock lock;
  return shim_lock(shim->file, TWIN_LOCK_PROGRAM, F_OFD_GETLK, &lock) == 0 &&
         lock.l_type != F_UNLCK;
}

static void shim_path(struct shim* shim, const char* given, const char* usual, char* path,
                      size_t size) {
  if (given != NULL && given[0] != '\0') {
    snprintf(shim->name, sizeof shim->name, "%s%s", given[0] == '/' ? "" : "/", given);
  } else {
    snprintf(shim->name, sizeof shim->name, usual, (unsigned)shim_user());
  }
  snprintf(path, size, "/dev/shm%s", shim->name);
}

/* Maps the file and holds this side's byte. */
static int shim_take(struct shim* shim) {
  struct flock lock;
  if (shim_lock(shim->file, TWIN_LOCK_SHIM, F_OFD_SETLK, &lock) != 0) {
    SHIM_ERROR("%s: another component uses %s already\n", shim->component, shim->name);
    return -EBUSY;
  }
  void* memory =
      mmap(NULL, sizeof(struct twin_segment), PROT_READ | PROT_WRITE, MAP_SHARED, shim->file, 0);
  if (memory == MAP_FAILED) {
    SHIM_ERROR("%s: %s cannot be mapped: %s\n", shim->component, shim->name, strerror(errno));
    return -errno;
  }
  shim->segment = (struct twin_segment*)memory;
  return 0;
}

static void shim_close(struct shim* shim) {
  if (shim->segment != NULL) {
    munmap(shim->segment, sizeof(struct twin_segment));
    shim->segment = NULL;
  }
  if (shim->file >= 0) {
    close(shim->file);
    shim->file = -1;
  }
}

static int shim_has_owner(const struct shim* shim, const struct stat* status) {
  if (status->st_uid != shim_user() || (status->st_mode & 077) != 0) {
    SHIM_ERROR("%s: %s belongs to user %u with mode %03o, not to user %u alone\n", shim->component,
               shim->name, (unsigned)status->st_uid, (unsigned)(status->st_mode & 0777),
               (unsigned)shim_user());
    return 0;
  }
  return 1;
}

/* The program's turn. */
static void shim_ask(struct twin_segment* s) {
  __atomic_add_fetch(&s->asked, 1, __ATOMIC_RELEASE);
  syscall(SYS_futex, &s->asked, FUTEX_WAKE, INT_MAX, NULL, NULL, 0);
}

static int shim_is_answered(const struct twin_segment* s) {
  return __atomic_load_n(&s->answered, __ATOMIC_ACQUIRE) ==
         __atomic_load_n(&s->asked, __ATOMIC_RELAXED);
}

/* Waits for the answer until an instant [ns]; false where it does not come. */
static int shim_wait(struct twin_segment* s, int64_t until) {
  while (!shim_is_answered(s)) {
    const uint32_t seen = __atomic_load_n(&s->answered, __ATOMIC_ACQUIRE);
    if (seen == __atomic_load_n(&s->asked, __ATOMIC_RELAXED)) {
      break;
    }
    if (shim_now() >= until) {
      return 0;
    }
    const struct timespec end = {(time_t)(until / 1000000000LL), (long)(until % 1000000000LL)};
    syscall(SYS_futex, &s->answered, FUTEX_WAIT_BITSET, seen, &end, NULL, FUTEX_BITSET_MATCH_ANY);
  }
  return 1;
}

/* What rtapi_app_main() begins with once the memory is there: its name in the HAL, and zeroed memory of
 * the HAL for its pins. NULL where that fails; let_go gives the segment back. */
static void* shim_begin(struct shim* shim, int* id, size_t size, void (*let_go)(struct shim*),
                        int* bad) {
  void* memory;
  *id = hal_init(shim->component);
  if (*id < 0) {
    *bad = *id;
    let_go(shim);
    return NULL;
  }
  memory = hal_malloc((long)size);
  if (memory == NULL) {
    *bad = -ENOMEM;
    hal_exit(*id);
    let_go(shim);
    return NULL;
  }
  memset(memory, 0, size);
  return memory;
}

/* And what it ends with: ready, or nothing left of it. */
static int shim_end(struct shim* shim, int id, int bad, void (*let_go)(struct shim*)) {
  if (bad) {
    hal_exit(id);
    let_go(shim);
    return bad < 0 ? bad : -EINVAL;
  }
  hal_ready(id);
  return 0;
}

static double shim_finite(double value) { return isfinite(value) ? value : 0.0; }

#endif
