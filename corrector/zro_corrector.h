/* The corrector for C programs (C99). No allocation, no global state: each gyro has its own
 * zro_corrector, wherever the caller keeps it. Not thread-safe: one thread a gyro. Calls are
 * bounded in time and do no I/O, except that a commit calls the storage.
 *
 * Implements the method of US 8,577,633 B2. Units are in the names; three axes x, y, z. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define ZRO_STATE_BYTES 2048 /* one gyro: table, evidence, windows, the face itself */
#define ZRO_SLOT_BYTES 1184  /* one of the two slots of the storage */

typedef struct {
  uint64_t opaque[ZRO_STATE_BYTES / 8];
} zro_corrector;

/* Two slots, each written whole. A write may be cut by a power failure at any byte. Calls block
 * until done and return false on failure. */
typedef struct {
  void* context;
  bool (*read)(void* context, int slot, uint8_t* out, size_t size);
  bool (*write)(void* context, int slot, const uint8_t* bytes, size_t size);
} zro_storage;

typedef struct {
  float rate_dps[3]; /* uncorrected gyro */
  float accel_g[3];  /* gravity included */
  float temp_degc;   /* of the gyro's package; may be held over several samples */
  uint32_t elapsed;  /* nominal sample periods since the previous sample; 1 = consecutive */
  bool gyro_clipped; /* an axis at full scale */
  bool accel_clipped;
  bool overrun; /* the sensor lost samples before this one */
} zro_sample;

typedef struct {
  float rate_dps[3]; /* corrected: raw minus zro_dps */
  float zro_dps[3];  /* offset subtracted */
  float sigma_dps;   /* its 1-sigma uncertainty, worst axis */
  uint8_t source;    /* where it comes from: zro::Source in types.h */
  uint8_t bin;       /* of the table; 63: none */
  uint16_t age_days; /* of the nearest entry; 0xFFFF: unknown */
  bool still;        /* declared motionless */
  bool learning;     /* a reading is being averaged */
  bool vibration;    /* gyro noise well above its floor */
  bool updated;      /* this sample wrote the table */
} zro_output;

typedef struct {
  uint32_t seq;    /* counts the events since boot */
  uint32_t sample; /* index of the sample it was decided at */
  uint8_t code;    /* 1-16: a reading was refused; 32-41: what was done (zro::Code in types.h) */
  uint8_t axis;    /* worst axis; 3: none */
  uint8_t bin;
  float temp_degc;
  float measured_dps[3];
  float limit; /* what decided ... */
  float value; /* ... and what was compared with it, in the same unit */
} zro_event;

/* Prepares the state and loads the newest valid slot. `storage` is borrowed for as long as the
 * corrector is used; NULL: the table lives in RAM only. Noise density: the datasheet's. */
void zro_init(zro_corrector* corrector, float sample_hz, float noise_density_dps_per_rthz,
              const zro_storage* storage);

/* Days since 1984-01-01; 0: unknown. */
void zro_set_date(zro_corrector* corrector, uint16_t days);

/* An entry measured at the factory; zro_commit() stores it. False: unfit, or no room. */
bool zro_add_factory_entry(zro_corrector* corrector, float temp_degc, const float zro_dps[3],
                           float sigma_dps);

/* One sample in, one corrected rate out. */
void zro_step(zro_corrector* corrector, const zro_sample* sample, zro_output* out);

/* The oldest decision not yet taken; false: none. Seven are kept. */
bool zro_pop_event(zro_corrector* corrector, zro_event* out);

/* Stores what is not yet stored: before an orderly shutdown. False: the storage failed. */
bool zro_commit(zro_corrector* corrector);

/* Drops what was learned, keeps the factory's entries, commits. */
bool zro_restore_factory(zro_corrector* corrector);

#ifdef __cplusplus
}
#endif
