/* SPDX-License-Identifier: MIT
 *
 * Copyright 2026 the twin authors
 *
 * Permission is hereby granted, free of charge, to any person obtaining a copy of this software and
 * associated documentation files (the "Software"), to deal in the Software without restriction,
 * including without limitation the rights to use, copy, modify, merge, publish, distribute,
 * sublicense, and/or sell copies of the Software, and to permit persons to whom the Software is
 * furnished to do so, subject to the following conditions:
 *
 * The above copyright notice and this permission notice shall be included in all copies or
 * substantial portions of the Software.
 *
 * THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR IMPLIED, INCLUDING BUT
 * NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY, FITNESS FOR A PARTICULAR PURPOSE AND
 * NONINFRINGEMENT. IN NO EVENT SHALL THE AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM,
 * DAMAGES OR OTHER LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
 * OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE SOFTWARE.
 *
 * The memory that a component of LinuxCNC's HAL (the shim) and the program twin share. It is the
 * only file that both include, in C and in C++.
 *
 * A period is a question and its answer:
 *
 *   shim                                        program
 *   ----                                        -------
 *   writes its half, ++asked, wakes   ------->  waits for asked to change
 *   waits for answered == asked       <-------  writes its half, answered = asked, wakes
 *
 * The half of the shim is the drive commands where the program is the plant (TWIN_USE_PLANT), and
 * the feedback where the program is the controller (TWIN_USE_CONTROLLER). asked and answered are
 * futex words; they and magic are read and written as atomics, with acquire and release. All else
 * belongs to the side whose turn it is.
 *
 * Each side keeps a lock of the open file description (F_OFD_SETLK) on one byte of the file as long
 * as it lives: TWIN_LOCK_SHIM or TWIN_LOCK_PROGRAM. So the other one can tell whether it is there,
 * however it ended and in whatever namespace of processes.
 */
#ifndef TWIN_HAL_LINUXCNC_SEGMENT_H
#define TWIN_HAL_LINUXCNC_SEGMENT_H

#include <stdint.h>

#define TWIN_SEGMENT_MAGIC 0x314C4E4957544E43ULL
#define TWIN_SEGMENT_VERSION 1u
#define TWIN_SEGMENT_AXES 8
#define TWIN_SEGMENT_NAME 16 /* letters of an axis, with the end */

#define TWIN_PLANT_SEGMENT "/twin-plant-%u"           /* by the user's number */
#define TWIN_CONTROLLER_SEGMENT "/twin-controller-%u" /* the same */

enum { TWIN_LOCK_SHIM = 0, TWIN_LOCK_PROGRAM = 1 };   /* bytes of the file */
enum { TWIN_USE_PLANT = 1, TWIN_USE_CONTROLLER = 2 }; /* what the program is */
enum { TWIN_AXIS_SERVO = 1, TWIN_AXIS_POSITION = 2 }; /* driven by volts, or by a set point */
enum {                                                /* bits of twin_command.faults */
       TWIN_FAULT_ENCODER_FROZEN = 1,
       TWIN_FAULT_VREF_OPEN = 2,
       TWIN_FAULT_ALARM = 4,
       TWIN_FAULT_LIMIT_POSITIVE = 8,
       TWIN_FAULT_LIMIT_NEGATIVE = 16,
       TWIN_FAULT_WIRE_BROKEN = 32
};
enum { TWIN_WIRED_COUNT = 1, TWIN_WIRED_POSITION = 2, TWIN_WIRED_READY = 4, TWIN_WIRED_OUTPUT = 8 };

/* From the controller to the machine. */
struct twin_command {
  double volts;      /* V-REF [V] */
  double position;   /* set point; moves a TWIN_AXIS_POSITION, else for the record alone [mm] */
  double offset;     /* between the encoder's coordinates and those of `position` [mm] */
  double load_force; /* on the slide from outside [N] */
  uint32_t servo_on;
  uint32_t fault_reset; /* a rising edge clears an alarm */
  uint32_t faults;      /* TWIN_FAULT_... that are injected */
  uint32_t is_recorded; /* whether `position` is one to record */
};

/* From the machine to the controller. */
struct twin_feedback {
  int64_t counts;        /* edges of the encoder since the machine was switched on [counts] */
  int64_t index_counts;  /* counts at the index mark that was passed last [counts] */
  double position;       /* measured, of an axis that has no counts [mm] */
  double velocity;       /* [mm/s] */
  double torque;         /* of the motor [N.m] */
  double friction;       /* of the slide, positive against positive motion [N] */
  double table_position; /* where the slide truly is [mm] */
  uint32_t index_marks;  /* passed so far */
  uint32_t ready;
  uint32_t alarm;
  uint32_t limit_positive;
  uint32_t limit_negative;
  uint32_t wired; /* TWIN_WIRED_...: what of a controller's pins is connected */
};

struct twin_axis {
  char name[TWIN_SEGMENT_NAME];
  uint32_t kind;             /* TWIN_AXIS_... */
  uint32_t home_is_positive; /* the home switch is the positive limit switch, else the negative */
  double mm_per_count;       /* encoder scale, signed [mm/count] */
  double mm_per_s_per_volt;  /* V-REF scale, signed [mm/s/V] */
  struct twin_command command;
  struct twin_feedback feedback;
};

struct twin_segment {
  uint64_t magic;     /* TWIN_SEGMENT_MAGIC, last of all when it is made */
  uint32_t version;   /* TWIN_SEGMENT_VERSION */
  uint32_t size;      /* of this struct [bytes] */
  uint32_t use;       /* TWIN_USE_... */
  uint32_t axes;      /* in use */
  double period;      /* of a question [s]: of the machine file, and of the shim's thread */
  double seen_period; /* of the other side, where it differs [s]; 0: not known yet */
  int32_t program;    /* process, for messages */
  int32_t shim;       /* process, for messages */

  uint32_t asked;    /* futex word of the program */
  uint32_t answered; /* futex word of the shim */
  uint64_t periods_asked;
  uint64_t periods_answered; /* with a period simulated, or with set points of a controller */
  double time;               /* of the plant [s] */

  uint32_t is_recording;     /* plant: this period is one of a program */
  int32_t line;              /* plant: NC line, 0: none */
  uint32_t is_estop;         /* controller: the machine must be at rest */
  uint32_t is_hold;          /* controller: feed hold */
  double feed_override;      /* controller: share of the programmed feedrate; 0 holds */
  uint32_t is_running;       /* controller: the program drives */
  uint32_t has_switched_off; /* controller: the shim has, since the last is_running */
  uint32_t late;             /* controller: periods without an answer in time */
  uint32_t hold_periods;     /* controller: that a missed answer holds the outputs */

  struct twin_axis axis[TWIN_SEGMENT_AXES];
};

#endif
