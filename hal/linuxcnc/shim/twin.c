/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * HAL component `twin`: the table of `twin plant` behind the pins of drives and encoders.
 *
 *   loadrt twin
 *   addf twin.read servo-thread     before motion-controller
 *   addf twin.write servo-thread    after the position loops
 */
#include "plant.h"

MODULE_AUTHOR("the twin authors");
MODULE_DESCRIPTION("a servo table with friction and drives behind HAL pins");
MODULE_LICENSE("GPL");

static char* segment = "";
RTAPI_MP_STRING(segment, "shared memory of the plant; /twin-plant-UID where it is not given");

struct drive_pins {
  hal_float_t *volts, *velocity_cmd, *position_cmd, *load_force;
  hal_bit_t *enable, *fault_reset;
  hal_float_t *position_fb, *velocity_fb, *torque_fb, *friction, *table_position;
  hal_s32_t *count, *rawcounts;
  hal_bit_t *ready, *fault, *limit_pos, *limit_neg, *home;
  hal_bit_t* inject[6];
};

struct instance {
  struct plant plant;
  struct drive_pins drive[TWIN_SEGMENT_AXES];
};

static struct instance* it;
static int id;

static const struct {
  const char* name;
  uint32_t bit;
} injected[6] = {{"inject-encoder-frozen", TWIN_FAULT_ENCODER_FROZEN},
                 {"inject-vref-open", TWIN_FAULT_VREF_OPEN},
                 {"inject-alarm", TWIN_FAULT_ALARM},
                 {"inject-limit-pos", TWIN_FAULT_LIMIT_POSITIVE},
                 {"inject-limit-neg", TWIN_FAULT_LIMIT_NEGATIVE},
                 {"inject-wire-broken", TWIN_FAULT_WIRE_BROKEN}};

static int servo_pins(struct drive_pins* d, struct plant_axis* a, const char* n) {
  int i;
  int bad = hal_pin_float_newf(HAL_IN, &d->volts, id, "twin.%s.volts", n) ||
            hal_pin_float_newf(HAL_IN, &d->velocity_cmd, id, "twin.%s.velocity-cmd", n) ||
            hal_pin_float_newf(HAL_IN, &d->load_force, id, "twin.%s.load-force", n) ||
            hal_pin_bit_newf(HAL_IN, &d->enable, id, "twin.%s.enable", n) ||
            hal_pin_bit_newf(HAL_IN, &d->fault_reset, id, "twin.%s.fault-reset", n) ||
            hal_pin_float_newf(HAL_OUT, &d->position_fb, id, "twin.%s.position-fb", n) ||
            hal_pin_float_newf(HAL_OUT, &d->velocity_fb, id, "twin.%s.velocity-fb", n) ||
            hal_pin_float_newf(HAL_OUT, &d->torque_fb, id, "twin.%s.torque-fb", n) ||
            hal_pin_float_newf(HAL_OUT, &d->friction, id, "twin.%s.friction", n) ||
            hal_pin_float_newf(HAL_OUT, &d->table_position, id, "twin.%s.table-position", n) ||
            hal_pin_s32_newf(HAL_OUT, &d->count, id, "twin.%s.count", n) ||
            hal_pin_s32_newf(HAL_OUT, &d->rawcounts, id, "twin.%s.rawcounts", n) ||
            hal_pin_bit_newf(HAL_IO, &a->index_enable, id, "twin.%s.index-enable", n) ||
            hal_pin_bit_newf(HAL_OUT, &d->ready, id, "twin.%s.ready", n) ||
            hal_pin_bit_newf(HAL_OUT, &d->fault, id, "twin.%s.fault", n) ||
            hal_pin_bit_newf(HAL_OUT, &d->limit_pos, id, "twin.%s.limit-pos", n) ||
            hal_pin_bit_newf(HAL_OUT, &d->limit_neg, id, "twin.%s.limit-neg", n) ||
            hal_pin_bit_newf(HAL_OUT, &d->home, id, "twin.%s.home", n) ||
            hal_param_float_newf(HAL_RW, &a->position_scale, id, "twin.%s.position-scale", n);
  for (i = 0; !bad && i < 6; ++i) {
    bad = hal_pin_bit_newf(HAL_IN, &d->inject[i], id, "twin.%s.%s", n, injected[i].name);
  }
  return bad;
}

static int slide_pins(struct drive_pins* d, const char* n) {
  return hal_pin_float_newf(HAL_IN, &d->position_cmd, id, "twin.%s.position-cmd", n) ||
         hal_pin_float_newf(HAL_OUT, &d->position_fb, id, "twin.%s.position-fb", n);
}

static void write_drives(void* arg, long period) {
  struct instance* t = arg;
  struct twin_segment* s = t->plant.shim.segment;
  uint32_t i;
  int k;
  if (!plant_may_ask(&t->plant, period)) {
    return;
  }
  for (i = 0; i < s->axes; ++i) {
    struct twin_axis* axis = &s->axis[i];
    const struct drive_pins* d = &t->drive[i];
    if (axis->kind != TWIN_AXIS_SERVO) {
      axis->command.position = shim_finite(*d->position_cmd);
      continue;
    }
    axis->command.volts = shim_finite(*d->volts + *d->velocity_cmd / axis->mm_per_s_per_volt);
    axis->command.load_force = shim_finite(*d->load_force);
    axis->command.servo_on = *d->enable ? 1 : 0;
    axis->command.fault_reset = *d->fault_reset ? 1 : 0;
    axis->command.faults = 0;
    for (k = 0; k < 6; ++k) {
      axis->command.faults |= *d->inject[k] ? injected[k].bit : 0;
    }
  }
  plant_ask(&t->plant);
}

static void read_drives(void* arg, long period) {
  struct instance* t = arg;
  const struct twin_segment* s = t->plant.shim.segment;
  const int is_there = plant_wait(&t->plant);
  uint32_t i;
  (void)period;
  for (i = 0; i < s->axes; ++i) {
    const struct twin_axis* axis = &s->axis[i];
    struct drive_pins* d = &t->drive[i];
    if (axis->kind != TWIN_AXIS_SERVO) {
      if (is_there) {
        *d->position_fb = axis->feedback.position;
      }
      continue;
    }
    *d->ready = is_there && axis->feedback.ready;
    *d->fault = !is_there || axis->feedback.alarm;
    if (!is_there) {
      *d->velocity_fb = 0.0;
      continue;
    }
    const int64_t counts = plant_counts(&t->plant, i);
    *d->count = plant_wrapped(counts);
    *d->rawcounts = plant_wrapped(axis->feedback.counts);
    *d->position_fb = (double)counts / t->plant.axis[i].position_scale;
    *d->velocity_fb = axis->feedback.velocity;
    *d->torque_fb = axis->feedback.torque;
    *d->friction = axis->feedback.friction;
    *d->table_position = axis->feedback.table_position - axis->command.offset;
    *d->limit_pos = axis->feedback.limit_positive;
    *d->limit_neg = axis->feedback.limit_negative;
    *d->home =
        axis->home_is_positive ? axis->feedback.limit_positive : axis->feedback.limit_negative;
  }
}

int rtapi_app_main(void) {
  const char* names[TWIN_SEGMENT_AXES];
  struct shim shim = {NULL, -1, "", "twin"};
  uint32_t i;
  int bad = plant_open(&shim, segment, TWIN_PLANT_SEGMENT, TWIN_USE_PLANT, PLANT_START);
  if (bad) {
    return bad;
  }
  it = shim_begin(&shim, &id, sizeof *it, shim_close, &bad);
  if (it == NULL) {
    return bad;
  }
  it->plant.shim = shim;
  for (i = 0; i < shim.segment->axes; ++i) {
    names[i] = shim.segment->axis[i].name;
  }
  bad = plant_pins(&it->plant, id, "twin", names);
  for (i = 0; !bad && i < shim.segment->axes; ++i) {
    bad = shim.segment->axis[i].kind == TWIN_AXIS_SERVO
              ? servo_pins(&it->drive[i], &it->plant.axis[i], names[i])
              : slide_pins(&it->drive[i], names[i]);
  }
  bad = bad || hal_export_funct("twin.read", read_drives, it, 1, 0, id) ||
        hal_export_funct("twin.write", write_drives, it, 1, 0, id);
  return shim_end(&shim, id, bad, shim_close);
}

void rtapi_app_exit(void) {
  hal_exit(id);
  shim_close(&it->plant.shim);
}
