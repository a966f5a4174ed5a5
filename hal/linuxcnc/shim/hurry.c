/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * A preload that makes LinuxCNC's threads sleep a share of their periods, so that LinuxCNC, its
 * position loops and a plant in lockstep go faster than the wall clock. For simulations only.
 *
 *   TWIN_HURRY=8 LD_PRELOAD=.../hurry.so linuxcnc FILE.ini
 *
 * An absolute sleep until t is one until t_0 + (t - t_0) / TWIN_HURRY, t_0 the first one's instant
 * asked for. A thread that falls behind does not sleep, as without the preload.
 */
#include <dlfcn.h>
#include <pthread.h>
#include <stdint.h>
#include <stdlib.h>
#include <time.h>

typedef int (*sleep_function)(clockid_t, int, const struct timespec*, struct timespec*);

static double speed(void) {
  const char* text = getenv("TWIN_HURRY");
  const double given = text != NULL ? atof(text) : 1.0;
  return given > 1.0 ? given : 1.0;
}

static int64_t ns_of(const struct timespec* t) {
  return (int64_t)t->tv_sec * 1000000000LL + t->tv_nsec;
}

int clock_nanosleep(clockid_t clock, int flags, const struct timespec* until,
                    struct timespec* left) {
  static _Thread_local int64_t asked; /* of the first sleep of the thread [ns] */
  static _Thread_local int64_t begun;
  static sleep_function next;
  if (next == NULL) {
    next = (sleep_function)dlsym(RTLD_NEXT, "clock_nanosleep");
  }
  const double factor = speed();
  if ((flags & TIMER_ABSTIME) == 0 || factor == 1.0) {
    return next(clock, flags, until, left);
  }
  struct timespec now;
  clock_gettime(clock, &now);
  if (asked == 0) {
    asked = ns_of(until);
    begun = ns_of(&now);
  }
  const int64_t at = begun + (int64_t)((double)(ns_of(until) - asked) / factor);
  if (at <= ns_of(&now)) {
    /* The thread is late: it catches up from here, without a burst that lasts. */
    begun = ns_of(&now);
    asked = ns_of(until);
    return 0;
  }
  const struct timespec sooner = {(time_t)(at / 1000000000LL), (long)(at % 1000000000LL)};
  return next(clock, flags, &sooner, left);
}
