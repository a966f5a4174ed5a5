/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * A plant behind the pins: the half of both its components, twin and hal_stg, that asks
 * `twin plant` for a period and waits for it.
 */
#ifndef TWIN_SHIM_PLANT_H
#define TWIN_SHIM_PLANT_H

#include "shim.h"

#define PLANT_START "start the table with 'twin plant' first"

static int plant_is_ours(const struct shim* shim, uint32_t use) {
  const struct twin_segment* s = shim->segment;
  if (__atomic_load_n(&s->magic, __ATOMIC_ACQUIRE) != TWIN_SEGMENT_MAGIC ||
      s->version != TWIN_SEGMENT_VERSION || s->size != sizeof(struct twin_segment)) {
    SHIM_ERROR(
        "%s: %s is of another version of twin: magic %llx, version %u, %u bytes in place of "
        "%llx, %u, %u\n",
        shim->component, shim->name, (unsigned long long)s->magic, s->version, s->size,
        TWIN_SEGMENT_MAGIC, TWIN_SEGMENT_VERSION, (unsigned)sizeof(struct twin_segment));
    return 0;
  }
  if (s->use != use || s->axes < 1 || s->axes > TWIN_SEGMENT_AXES) {
    SHIM_ERROR("%s: %s is for another component\n", shim->component, shim->name);
    return 0;
  }
  return 1;
}

/* Opens the memory of a program that is there already. */
static int plant_open(struct shim* shim, const char* given, const char* usual, uint32_t use,
                      const char* start) {
  char path[96];
  struct stat status;
  shim->file = -1;
  shim_path(shim, given, usual, path, sizeof path);
  shim->file = open(path, O_RDWR | O_CLOEXEC | O_NOFOLLOW);
  if (shim->file < 0) {
    const int error = errno;
    SHIM_ERROR("%s: %s: %s; %s\n", shim->component, shim->name,
               error == ENOENT ? "no such shared memory" : strerror(error), start);
    return -error;
  }
  if (fstat(shim->file, &status) != 0 || !shim_has_owner(shim, &status)) {
    shim_close(shim);
    return -EPERM;
  }
  if (status.st_size != (off_t)sizeof(struct twin_segment)) {
    SHIM_ERROR("%s: %s is of another version of twin: %lld bytes in place of %u\n", shim->component,
               shim->name, (long long)status.st_size, (unsigned)sizeof(struct twin_segment));
    shim_close(shim);
    return -EPROTO;
  }
  if (!shim_has_program(shim)) {
    SHIM_ERROR("%s: %s was left by a program that has ended; %s\n", shim->component, shim->name,
               start);
    shim_close(shim);
    return -ESRCH;
  }
  int result = shim_take(shim);
  if (result == 0 && !plant_is_ours(shim, use)) {
    result = -EPROTO;
  }
  if (result != 0) {
    shim_close(shim);
    return result;
  }
  shim->segment->shim = (int32_t)getpid();
  return 0;
}

struct plant_axis {
  hal_bit_t* index_enable;
  hal_float_t* commanded;     /* set point of the joint, for the record [mm] */
  hal_float_t* motor_offset;  /* of the joint [mm] */
  hal_float_t* unconnected;   /* where `commanded` points while no signal is on it */
  hal_float_t position_scale; /* [counts/mm] */
  int64_t origin;             /* counts at zero [counts] */
  uint32_t marks;             /* index marks passed, as last read */
};

struct plant {
  struct shim shim;
  struct plant_axis axis[TWIN_SEGMENT_AXES];
  hal_bit_t* connected;
  hal_bit_t* pause;
  hal_bit_t* record;
  hal_s32_t* line;
  hal_u32_t* stalls;  /* waits that were too long */
  hal_u32_t* periods; /* simulated */
  hal_u32_t* wait_ns; /* of the last period */
  hal_float_t* time;
  hal_u32_t timeout_ms;
  int is_lost;        /* no answer came in time, or the plant is gone */
  int is_period_told; /* the thread's period was found wrong */
};

static int plant_pins(struct plant* p, int id, const char* prefix, const char* const* names) {
  const struct twin_segment* s = p->shim.segment;
  uint32_t i;
  int bad = hal_pin_bit_newf(HAL_OUT, &p->connected, id, "%s.connected", prefix) ||
            hal_pin_bit_newf(HAL_IN, &p->pause, id, "%s.pause", prefix) ||
            hal_pin_bit_newf(HAL_IN, &p->record, id, "%s.record", prefix) ||
            hal_pin_s32_newf(HAL_IN, &p->line, id, "%s.line", prefix) ||
            hal_pin_u32_newf(HAL_OUT, &p->stalls, id, "%s.stalls", prefix) ||
            hal_pin_u32_newf(HAL_OUT, &p->periods, id, "%s.periods", prefix) ||
            hal_pin_u32_newf(HAL_OUT, &p->wait_ns, id, "%s.wait-ns", prefix) ||
            hal_pin_float_newf(HAL_OUT, &p->time, id, "%s.time", prefix) ||
            hal_param_u32_newf(HAL_RW, &p->timeout_ms, id, "%s.timeout-ms", prefix);
  for (i = 0; !bad && i < s->axes; ++i) {
    struct plant_axis* a = &p->axis[i];
    bad = hal_pin_float_newf(HAL_IN, &a->commanded, id, "%s.%s.commanded", prefix, names[i]) ||
          hal_pin_float_newf(HAL_IN, &a->motor_offset, id, "%s.%s.motor-offset", prefix, names[i]);
    if (!bad) {
      a->unconnected = a->commanded;
      a->position_scale = 1.0 / s->axis[i].mm_per_count;
      a->origin = 0;
      a->marks = s->axis[i].feedback.index_marks;
    }
  }
  if (bad) {
    return -EINVAL;
  }
  *p->record = 1;
  p->timeout_ms = 1000;
  return 0;
}

/* Before the drives of the segment are filled in: whether a period may be asked for. */
static int plant_may_ask(struct plant* p, long period) {
  struct twin_segment* s = p->shim.segment;
  const double seen = (double)period * 1e-9;
  s->seen_period = seen;
  if (fabs(seen - s->period) > 0.005 * s->period) {
    if (!p->is_period_told) {
      SHIM_ERROR(
          "%s: the thread's period is %.3f ms, the plant's %.3f ms: set SERVO_PERIOD to %.0f, "
          "or interpolator.period_ms of the machine file\n",
          p->shim.component, seen * 1e3, s->period * 1e3, s->period * 1e9);
    }
    p->is_period_told = 1;
    return 0;
  }
  return !p->is_lost;
}

/* What goes with the drive commands of a period, and the question itself. */
static void plant_ask(struct plant* p) {
  struct twin_segment* s = p->shim.segment;
  uint32_t i;
  for (i = 0; i < s->axes; ++i) {
    const struct plant_axis* a = &p->axis[i];
    struct twin_command* command = &s->axis[i].command;
    command->offset = (double)a->origin / a->position_scale + shim_finite(*a->motor_offset);
    command->is_recorded = a->commanded != a->unconnected;
    if (s->axis[i].kind == TWIN_AXIS_SERVO) {
      command->position = shim_finite(*a->commanded);
    }
  }
  s->is_recording = *p->record ? 1 : 0;
  s->line = *p->line;
  ++s->periods_asked;
  shim_ask(s);
}

static void plant_lose(struct plant* p, const char* why) {
  struct twin_segment* s = p->shim.segment;
  p->is_lost = 1;
  *p->connected = 0;
  SHIM_ERROR("%s: the plant, process %d, %s; its drives give alarm until it answers\n",
             p->shim.component, s->program, why);
}

/* Waits for the answer. False where the plant is not there, or has not been asked yet. */
static int plant_wait(struct plant* p) {
  struct twin_segment* s = p->shim.segment;
  const int64_t start = shim_now();
  const int64_t end = start + (int64_t)p->timeout_ms * 1000000LL;
  while (*p->pause) {
    const struct timespec nap = {0, 1000000};
    nanosleep(&nap, NULL);
  }
  if (p->is_lost) {
    if (!shim_is_answered(s) || !shim_has_program(&p->shim)) {
      return 0;
    }
    p->is_lost = 0;
    SHIM_ERROR("%s: the plant answers again, process %d\n", p->shim.component, s->program);
  }
  while (!shim_is_answered(s)) {
    const int64_t now = shim_now();
    if (!shim_wait(s, now + SHIM_SLICE_NS < end ? now + SHIM_SLICE_NS : end)) {
      if (!shim_has_program(&p->shim)) {
        plant_lose(p, "is gone");
        return 0;
      }
      if (shim_now() >= end) {
        ++*p->stalls;
        plant_lose(p, "has not answered in time");
        return 0;
      }
    }
  }
  *p->connected = !p->is_period_told;
  *p->wait_ns = (hal_u32_t)(shim_now() - start);
  *p->periods = (hal_u32_t)s->periods_answered;
  *p->time = s->time;
  return !p->is_period_told;
}

/* Counts since the zero of an axis, which an index mark moves while its index-enable is on. */
static int64_t plant_counts(struct plant* p, uint32_t i) {
  struct plant_axis* a = &p->axis[i];
  const struct twin_feedback* feedback = &p->shim.segment->axis[i].feedback;
  if (a->index_enable != NULL && *a->index_enable && feedback->index_marks != a->marks) {
    a->origin = feedback->index_counts;
    *a->index_enable = 0;
  }
  a->marks = feedback->index_marks;
  if (fabs(a->position_scale) < 1e-9 || !isfinite(a->position_scale)) {
    a->position_scale = 1.0;
  }
  return feedback->counts - a->origin;
}

/* A counter of 32 bits, which wraps. */
static int32_t plant_wrapped(int64_t counts) { return (int32_t)(uint32_t)(uint64_t)counts; }

#endif
