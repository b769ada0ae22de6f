/* Two gyros, each with its own corrector, its own two flash slots and its own learning.
 *
 *   cc -I. examples/two_gyros.c -x c++ corrector/[a-z]*.cc -lm -o two_gyros && ./two_gyros
 *
 * The loop is what a product does at each sample. Here the sensors are made up: at rest, noisy,
 * warming by 4 degC/min, with offsets that grow with temperature. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "corrector/zro_corrector.h"

enum { kGyros = 2, kHz = 100, kMinutes = 5 };

typedef struct {
  uint8_t slots[2][ZRO_SLOT_BYTES]; /* a product's flash */
  zro_storage storage;
  zro_corrector corrector;
  float offset_dps, slope_dps_per_degc; /* what the corrector is to find out */
} gyro;

static bool ReadSlot(void* context, int slot, uint8_t* out, size_t size) {
  memcpy(out, ((gyro*)context)->slots[slot], size);
  return true;
}

static bool WriteSlot(void* context, int slot, const uint8_t* bytes, size_t size) {
  memcpy(((gyro*)context)->slots[slot], bytes, size);
  return true;
}

static float Noise(void) { /* uniform, 50 mdps rms */
  static uint32_t state = 1;
  state = state * 1664525u + 1013904223u;
  return 0.0866f * ((float)(state >> 8) / 8388608.0f - 1.0f);
}

static zro_sample Measure(const gyro* g, float temp_degc) {
  zro_sample sample = {.accel_g = {0, 0, 1}, .temp_degc = temp_degc, .elapsed = 1};
  for (int axis = 0; axis < 3; ++axis) {
    sample.rate_dps[axis] = g->offset_dps + g->slope_dps_per_degc * (temp_degc - 25) + Noise();
  }
  return sample;
}

int main(void) {
  static gyro gyros[kGyros] = {{.offset_dps = 0.8f, .slope_dps_per_degc = 0.03f},
                               {.offset_dps = -2.0f, .slope_dps_per_degc = -0.02f}};
  zro_output out = {{0}, {0}, 0, 0, 0, 0, false, false, false, false};
  for (int i = 0; i < kGyros; ++i) {
    gyro* g = &gyros[i];
    memset(g->slots, 0xFF, sizeof g->slots); /* blank */
    g->storage = (zro_storage){g, ReadSlot, WriteSlot};
    zro_init(&g->corrector, kHz, 0.005f, &g->storage);
    zro_set_date(&g->corrector, 15300);
    int decisions = 0;
    float temp_degc = 25;
    for (int n = 0; n < kMinutes * 60 * kHz; ++n) {
      temp_degc = 25 + (float)n / kHz * 4 / 60;
      const zro_sample sample = Measure(g, temp_degc);
      zro_step(&g->corrector, &sample, &out);
      for (zro_event event; zro_pop_event(&g->corrector, &event);) ++decisions;
    }
    zro_commit(&g->corrector);
    const float error = out.zro_dps[2] - (g->offset_dps + g->slope_dps_per_degc * (temp_degc - 25));
    printf(
        "gyro %d at %.1f degC: offset %+.3f dps, off by %.1f mdps (1 sigma %.1f), %d decisions\n",
        i, (double)temp_degc, (double)out.zro_dps[2], (double)(1e3f * fabsf(error)),
        (double)(1e3f * out.sigma_dps), decisions);
    if (fabsf(error) > 0.02f) return 1;
  }
  return 0;
}
