/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * HAL component `hal_stg`: the table of `twin plant` behind the pins and functions of the driver of
 * the Servo To Go card, so that HAL files which were written for that card load as they are.
 *
 *   channels 0, 1, 2   drives X, Y and a drive Z of OUTPUT 10 mm/s/V behind which the pen slide is
 *   in-00, 04, 08      home switch of the channel
 *   in-01, 05, 09      its positive limit switch, in-02, 06, 10 its negative one
 *   in-03, 07, 11      fault of its drive
 *   in-12              out-07 again: the chain of the emergency stop is closed
 *   out-00, 01, 02     enable of the channel's drive
 */
#include "plant.h"

MODULE_AUTHOR("the twin authors");
MODULE_DESCRIPTION("a servo table behind the pins of the Servo To Go driver");
MODULE_LICENSE("GPL");

static char* segment = "";
RTAPI_MP_STRING(segment, "shared memory of the plant; /twin-plant-UID where it is not given");
static int base = 0;
RTAPI_MP_INT(base, "address of the card; accepted and not used");
static int num_chan = 0;
RTAPI_MP_INT(num_chan, "channels; accepted and not used");
static char* dio = "";
RTAPI_MP_STRING(dio, "directions of the digital lines; accepted and not used");

#define LINES 16 /* of inputs, and of outputs */
enum { HOME = 0, LIMIT_POS = 1, LIMIT_NEG = 2, FAULT = 3, LINES_OF_CHANNEL = 4 };
enum { ESTOP_OUT = 7, ESTOP_IN = 12, LUBE_IN = 13 };

struct channel {
  hal_s32_t *counts, *rawcounts;
  hal_float_t *position, *dac_value, *adc_value;
  hal_bit_t* index_enable;
  hal_float_t dac_offset, dac_gain, adc_offset, adc_gain;
};

struct card {
  struct plant plant;
  struct channel channel[TWIN_SEGMENT_AXES];
  hal_bit_t *in[LINES], *in_not[LINES], *out[LINES];
  hal_bit_t out_invert[LINES];
  int is_there;
  uint32_t enabled; /* by do-write, a bit a channel */
};

static struct card* it;
static int id;

static void write_dacs(void* arg, long period) {
  struct card* card = arg;
  struct twin_segment* s = card->plant.shim.segment;
  uint32_t i;
  if (!plant_may_ask(&card->plant, period)) {
    return;
  }
  for (i = 0; i < s->axes; ++i) {
    const struct channel* c = &card->channel[i];
    struct twin_axis* axis = &s->axis[i];
    double volts = shim_finite((*c->dac_value - c->dac_offset) * c->dac_gain);
    volts = volts > 10.0 ? 10.0 : volts < -10.0 ? -10.0 : volts;
    if (axis->kind == TWIN_AXIS_SERVO) {
      axis->command.volts = volts;
      axis->command.servo_on = card->enabled >> i & 1;
    } else if (card->enabled >> i & 1) {
      axis->command.position += volts * axis->mm_per_s_per_volt * s->period;
    }
  }
  plant_ask(&card->plant);
}

static void capture_position(void* arg, long period) {
  struct card* card = arg;
  const struct twin_segment* s = card->plant.shim.segment;
  uint32_t i;
  (void)period;
  card->is_there = plant_wait(&card->plant);
  for (i = 0; card->is_there && i < s->axes; ++i) {
    const struct channel* c = &card->channel[i];
    const int64_t counts = plant_counts(&card->plant, i);
    *c->counts = plant_wrapped(counts);
    *c->rawcounts = plant_wrapped(s->axis[i].feedback.counts);
    *c->position = (double)counts / card->plant.axis[i].position_scale;
  }
}

static void read_inputs(void* arg, long period) {
  struct card* card = arg;
  const struct twin_segment* s = card->plant.shim.segment;
  uint32_t i;
  (void)period;
  for (i = 0; i < s->axes && LINES_OF_CHANNEL * i < ESTOP_IN; ++i) {
    const struct twin_axis* axis = &s->axis[i];
    hal_bit_t** in = &card->in[LINES_OF_CHANNEL * i];
    const int is_servo = axis->kind == TWIN_AXIS_SERVO;
    *in[LIMIT_POS] = is_servo && axis->feedback.limit_positive;
    *in[LIMIT_NEG] = is_servo && axis->feedback.limit_negative;
    *in[HOME] = axis->home_is_positive ? *in[LIMIT_POS] : *in[LIMIT_NEG];
    *in[FAULT] = is_servo && (!card->is_there || axis->feedback.alarm);
  }
  *card->in[ESTOP_IN] = *card->out[ESTOP_OUT];
  *card->in[LUBE_IN] = 1;
  for (i = 0; i < LINES; ++i) {
    *card->in_not[i] = !*card->in[i];
  }
}

static void write_outputs(void* arg, long period) {
  struct card* card = arg;
  uint32_t i;
  (void)period;
  card->enabled = 0;
  for (i = 0; i < card->plant.shim.segment->axes; ++i) {
    card->enabled |= (uint32_t)((*card->out[i] != 0) != (card->out_invert[i] != 0)) << i;
  }
}

static void read_adcs(void* arg, long period) {
  (void)arg;
  (void)period; /* nothing is connected to the analogue inputs */
}

static int channel_pins(uint32_t n) {
  struct channel* c = &it->channel[n];
  struct plant_axis* a = &it->plant.axis[n];
  c->dac_gain = 1.0;
  c->adc_gain = 1.0;
  return hal_pin_s32_newf(HAL_OUT, &c->counts, id, "stg.%u.counts", n) ||
         hal_pin_s32_newf(HAL_OUT, &c->rawcounts, id, "stg.%u.rawcounts", n) ||
         hal_pin_float_newf(HAL_OUT, &c->position, id, "stg.%u.position", n) ||
         hal_pin_bit_newf(HAL_IO, &a->index_enable, id, "stg.%u.index-enable", n) ||
         hal_param_float_newf(HAL_RW, &a->position_scale, id, "stg.%u.position-scale", n) ||
         hal_pin_float_newf(HAL_IN, &c->dac_value, id, "stg.%u.dac-value", n) ||
         hal_param_float_newf(HAL_RW, &c->dac_offset, id, "stg.%u.dac-offset", n) ||
         hal_param_float_newf(HAL_RW, &c->dac_gain, id, "stg.%u.dac-gain", n) ||
         hal_pin_float_newf(HAL_OUT, &c->adc_value, id, "stg.%u.adc-value", n) ||
         hal_param_float_newf(HAL_RW, &c->adc_offset, id, "stg.%u.adc-offset", n) ||
         hal_param_float_newf(HAL_RW, &c->adc_gain, id, "stg.%u.adc-gain", n);
}

static int line_pins(uint32_t n) {
  return hal_pin_bit_newf(HAL_OUT, &it->in[n], id, "stg.in-%02u", n) ||
         hal_pin_bit_newf(HAL_OUT, &it->in_not[n], id, "stg.in-%02u-not", n) ||
         hal_pin_bit_newf(HAL_IN, &it->out[n], id, "stg.out-%02u", n) ||
         hal_param_bit_newf(HAL_RW, &it->out_invert[n], id, "stg.out-%02u-invert", n);
}

int rtapi_app_main(void) {
  static const char* const names[TWIN_SEGMENT_AXES] = {"0", "1", "2", "3", "4", "5", "6", "7"};
  struct shim shim = {NULL, -1, "", "hal_stg"};
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
  bad = plant_pins(&it->plant, id, "stg", names);
  for (i = 0; !bad && i < shim.segment->axes; ++i) {
    bad = channel_pins(i);
  }
  for (i = 0; !bad && i < LINES; ++i) {
    bad = line_pins(i);
  }
  bad = bad || hal_export_funct("stg.capture-position", capture_position, it, 1, 0, id) ||
        hal_export_funct("stg.write-dacs", write_dacs, it, 1, 0, id) ||
        hal_export_funct("stg.read-adcs", read_adcs, it, 1, 0, id) ||
        hal_export_funct("stg.di-read", read_inputs, it, 0, 0, id) ||
        hal_export_funct("stg.do-write", write_outputs, it, 0, 0, id);
  return shim_end(&shim, id, bad, shim_close);
}

void rtapi_app_exit(void) {
  hal_exit(id);
  shim_close(&it->plant.shim);
}
