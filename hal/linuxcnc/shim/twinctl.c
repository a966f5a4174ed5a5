/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * HAL component `twinctl`: the controller `twin` on a machine that LinuxCNC's HAL drives.
 *
 *   loadrt twinctl axes=xy
 *   addf twinctl.read servo-thread     behind the functions that read encoders and inputs
 *   addf twinctl.write servo-thread    before those that write outputs
 *
 * An answer that does not come in time holds the outputs for hold-periods periods; then they are
 * 0 V and servo off, as they are at once when the program is gone, at an emergency stop, and as
 * long as no program drives. Nothing else than a program that begins anew switches on again.
 */
#include "shim.h"

MODULE_AUTHOR("the twin authors");
MODULE_DESCRIPTION("outputs of the controller twin as HAL pins");
MODULE_LICENSE("GPL");

static char* segment = "";
RTAPI_MP_STRING(segment, "shared memory; /twin-controller-UID where it is not given");
static char* axes = "xy";
RTAPI_MP_STRING(axes, "letters of the axes");

struct axis_pins {
  hal_float_t* position_fb;
  hal_s32_t* count;
  hal_bit_t *servo_ready, *fault, *limit_pos, *limit_neg, *index_enable;
  hal_float_t *volts, *velocity_cmd, *position_cmd;
  hal_bit_t *servo_on, *fault_reset;
  void* unconnected
      [5]; /* where position_fb, count, servo_ready, volts, velocity_cmd point at first */
  int32_t last_count;
  int64_t counts; /* of a counter that wraps */
  int is_armed;
};

struct instance {
  struct shim shim;
  struct axis_pins axis[TWIN_SEGMENT_AXES];
  hal_bit_t *running, *heartbeat, *estop, *feed_hold;
  hal_float_t* feed_override;
  hal_u32_t *late, *wait_ns;
  hal_u32_t hold_periods, deadline_us;
  int64_t read_at;   /* [ns] */
  int64_t answer_at; /* last answer [ns] */
  uint32_t missed;   /* periods without an answer in a row */
  int has_begun;     /* counters are known */
  int is_off;        /* outputs are at 0 V and servo off */
};

static struct instance* it;
static int id;

static uint32_t load(const uint32_t* word) { return __atomic_load_n(word, __ATOMIC_ACQUIRE); }
static void store(uint32_t* word, uint32_t value) {
  __atomic_store_n(word, value, __ATOMIC_RELEASE);
}

static uint32_t wired(const struct axis_pins* a) {
  return (a->count != a->unconnected[1] ? TWIN_WIRED_COUNT : 0U) |
         (a->position_fb != a->unconnected[0] ? TWIN_WIRED_POSITION : 0U) |
         (a->servo_ready != a->unconnected[2] ? TWIN_WIRED_READY : 0U) |
         (a->volts != a->unconnected[3] || a->velocity_cmd != a->unconnected[4] ? TWIN_WIRED_OUTPUT
                                                                                : 0U);
}

static void make_safe(struct instance* t) {
  uint32_t i;
  for (i = 0; i < t->shim.segment->axes; ++i) {
    struct axis_pins* a = &t->axis[i];
    *a->volts = 0.0;
    *a->velocity_cmd = 0.0;
    *a->servo_on = 0;
    *a->fault_reset = 0;
  }
  *t->running = 0;
  t->is_off = 1;
}

static void trip(struct instance* t, const char* why) {
  struct twin_segment* s = t->shim.segment;
  const double silent = (double)(shim_now() - t->answer_at) * 1e-6;
  make_safe(t);
  store(&s->has_switched_off, 1);
  SHIM_ERROR(
      "twinctl: 0 V and servo off, %.2f ms after the last answer: the controller, process %d, "
      "%s\n",
      silent, s->program, why);
}

static void read_inputs(void* arg, long period) {
  struct instance* t = arg;
  struct twin_segment* s = t->shim.segment;
  uint32_t i;
  s->period = (double)period * 1e-9;
  t->read_at = shim_now();
  __atomic_add_fetch(&s->periods_asked, 1, __ATOMIC_RELEASE);
  for (i = 0; i < s->axes; ++i) {
    struct axis_pins* a = &t->axis[i];
    const int32_t now = *a->count;
    a->counts += t->has_begun ? (int32_t)((uint32_t)now - (uint32_t)a->last_count) : 0;
    a->last_count = now;
  }
  t->has_begun = 1;
  if (!shim_is_answered(s)) {
    return; /* the memory is still the program's */
  }
  for (i = 0; i < s->axes; ++i) {
    struct axis_pins* a = &t->axis[i];
    struct twin_feedback* feedback = &s->axis[i].feedback;
    feedback->counts = a->counts;
    feedback->position = *a->position_fb;
    feedback->ready = *a->servo_ready;
    feedback->alarm = *a->fault;
    feedback->limit_positive = *a->limit_pos;
    feedback->limit_negative = *a->limit_neg;
    feedback->wired = wired(a);
    if (a->is_armed && !*a->index_enable) {
      ++feedback->index_marks;
    }
    *a->index_enable = 1;
    a->is_armed = 1;
  }
  s->is_estop = *t->estop;
  s->is_hold = *t->feed_hold;
  s->feed_override = *t->feed_override;
  s->hold_periods = t->hold_periods;
  shim_ask(s);
}

static void take_answer(struct instance* t) {
  struct twin_segment* s = t->shim.segment;
  uint32_t i;
  for (i = 0; i < s->axes; ++i) {
    struct axis_pins* a = &t->axis[i];
    const struct twin_command* command = &s->axis[i].command;
    const double volts = shim_finite(command->volts);
    *a->volts = command->servo_on ? (volts > 10.0 ? 10.0 : volts < -10.0 ? -10.0 : volts) : 0.0;
    *a->velocity_cmd = *a->volts * s->axis[i].mm_per_s_per_volt;
    *a->position_cmd = shim_finite(command->position);
    *a->servo_on = command->servo_on != 0;
    *a->fault_reset = command->fault_reset != 0;
  }
  *t->running = 1;
  *t->heartbeat = !*t->heartbeat;
  t->is_off = 0;
  t->missed = 0;
  t->answer_at = shim_now();
}

static void write_outputs(void* arg, long period) {
  struct instance* t = arg;
  struct twin_segment* s = t->shim.segment;
  const int64_t patience =
      t->deadline_us > 0 ? (int64_t)t->deadline_us * 1000LL : (int64_t)period * 7 / 10;
  if (!load(&s->is_running)) {
    if (!t->is_off) {
      make_safe(t);
    }
    store(&s->has_switched_off, 0);
    t->missed = 0;
    t->answer_at = shim_now();
    return;
  }
  if (load(&s->has_switched_off)) {
    return;
  }
  if (*t->estop) {
    trip(t, "met the emergency stop");
    return;
  }
  const int is_in_time = shim_wait(s, t->read_at + patience);
  *t->wait_ns = (hal_u32_t)(shim_now() - t->read_at);
  if (is_in_time) {
    take_answer(t);
    return;
  }
  ++*t->late;
  s->late = *t->late;
  if (!shim_has_program(&t->shim)) {
    trip(t, "is gone");
    store(&s->is_running, 0);
    return;
  }
  if (++t->missed > t->hold_periods) {
    trip(t, "does not answer any more");
  }
}

static int axis_pins(struct axis_pins* a, const char* n) {
  int bad = hal_pin_float_newf(HAL_IN, &a->position_fb, id, "twinctl.%s.position-fb", n) ||
            hal_pin_s32_newf(HAL_IN, &a->count, id, "twinctl.%s.count", n) ||
            hal_pin_bit_newf(HAL_IN, &a->servo_ready, id, "twinctl.%s.servo-ready", n) ||
            hal_pin_bit_newf(HAL_IN, &a->fault, id, "twinctl.%s.fault", n) ||
            hal_pin_bit_newf(HAL_IN, &a->limit_pos, id, "twinctl.%s.limit-pos", n) ||
            hal_pin_bit_newf(HAL_IN, &a->limit_neg, id, "twinctl.%s.limit-neg", n) ||
            hal_pin_bit_newf(HAL_IO, &a->index_enable, id, "twinctl.%s.index-enable", n) ||
            hal_pin_float_newf(HAL_OUT, &a->volts, id, "twinctl.%s.volts", n) ||
            hal_pin_float_newf(HAL_OUT, &a->velocity_cmd, id, "twinctl.%s.velocity-cmd", n) ||
            hal_pin_float_newf(HAL_OUT, &a->position_cmd, id, "twinctl.%s.position-cmd", n) ||
            hal_pin_bit_newf(HAL_OUT, &a->servo_on, id, "twinctl.%s.servo-on", n) ||
            hal_pin_bit_newf(HAL_OUT, &a->fault_reset, id, "twinctl.%s.fault-reset", n);
  if (!bad) {
    a->unconnected[0] = (void*)a->position_fb;
    a->unconnected[1] = (void*)a->count;
    a->unconnected[2] = (void*)a->servo_ready;
    a->unconnected[3] = (void*)a->volts;
    a->unconnected[4] = (void*)a->velocity_cmd;
  }
  return bad;
}

static int all_pins(struct instance* t) {
  uint32_t i;
  int bad = hal_pin_bit_newf(HAL_OUT, &t->running, id, "twinctl.running") ||
            hal_pin_bit_newf(HAL_OUT, &t->heartbeat, id, "twinctl.heartbeat") ||
            hal_pin_bit_newf(HAL_IN, &t->estop, id, "twinctl.estop") ||
            hal_pin_bit_newf(HAL_IN, &t->feed_hold, id, "twinctl.feed-hold") ||
            hal_pin_float_newf(HAL_IN, &t->feed_override, id, "twinctl.feed-override") ||
            hal_pin_u32_newf(HAL_OUT, &t->late, id, "twinctl.late") ||
            hal_pin_u32_newf(HAL_OUT, &t->wait_ns, id, "twinctl.wait-ns") ||
            hal_param_u32_newf(HAL_RW, &t->hold_periods, id, "twinctl.hold-periods") ||
            hal_param_u32_newf(HAL_RW, &t->deadline_us, id, "twinctl.deadline-us");
  for (i = 0; !bad && i < t->shim.segment->axes; ++i) {
    bad = axis_pins(&t->axis[i], t->shim.segment->axis[i].name);
  }
  if (!bad) {
    *t->feed_override = 1.0;
    t->hold_periods = 3;
    t->is_off = 1;
  }
  return bad;
}

/* Makes the memory, or takes over what another component has left. */
static int make_segment(struct shim* shim) {
  char path[96];
  struct stat status;
  int result;
  size_t i;
  const size_t count = strlen(axes);
  if (count < 1 || count > TWIN_SEGMENT_AXES) {
    SHIM_ERROR("twinctl: axes=%s names %u axes; 1 to %d can be\n", axes, (unsigned)count,
               TWIN_SEGMENT_AXES);
    return -EINVAL;
  }
  shim_path(shim, segment, TWIN_CONTROLLER_SEGMENT, path, sizeof path);
  shim->file = open(path, O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (shim->file < 0) {
    SHIM_ERROR("twinctl: %s cannot be made: %s\n", shim->name, strerror(errno));
    return -errno;
  }
  if (fstat(shim->file, &status) != 0 || !shim_has_owner(shim, &status)) {
    return -EPERM;
  }
  if (shim_has_program(shim)) {
    SHIM_ERROR("twinctl: a controller still holds %s; end it first\n", shim->name);
    return -EBUSY;
  }
  if (ftruncate(shim->file, (off_t)sizeof(struct twin_segment)) != 0) {
    SHIM_ERROR("twinctl: %s cannot be made large enough: %s\n", shim->name, strerror(errno));
    return -errno;
  }
  result = shim_take(shim);
  if (result != 0) {
    return result;
  }
  memset(shim->segment, 0, sizeof *shim->segment);
  shim->segment->version = TWIN_SEGMENT_VERSION;
  shim->segment->size = sizeof(struct twin_segment);
  shim->segment->use = TWIN_USE_CONTROLLER;
  shim->segment->axes = (uint32_t)count;
  shim->segment->shim = (int32_t)getpid();
  for (i = 0; i < count; ++i) {
    shim->segment->axis[i].name[0] = axes[i];
    shim->segment->axis[i].kind = TWIN_AXIS_SERVO;
  }
  __atomic_store_n(&shim->segment->magic, TWIN_SEGMENT_MAGIC, __ATOMIC_RELEASE);
  return 0;
}

static void drop_segment(struct shim* shim) {
  char path[96];
  if (shim->segment != NULL && !shim_has_program(shim)) {
    snprintf(path, sizeof path, "/dev/shm%s", shim->name);
    unlink(path);
  }
  shim_close(shim);
}

int rtapi_app_main(void) {
  struct shim shim = {NULL, -1, "", "twinctl"};
  int bad = make_segment(&shim);
  if (bad) {
    shim_close(&shim);
    return bad;
  }
  it = shim_begin(&shim, &id, sizeof *it, drop_segment, &bad);
  if (it == NULL) {
    return bad;
  }
  it->shim = shim;
  bad = all_pins(it) || hal_export_funct("twinctl.read", read_inputs, it, 1, 0, id) ||
        hal_export_funct("twinctl.write", write_outputs, it, 1, 0, id);
  return shim_end(&shim, id, bad, drop_segment);
}

void rtapi_app_exit(void) {
  make_safe(it);
  hal_exit(id);
  drop_segment(&it->shim);
}
