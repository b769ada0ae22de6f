#include "corrector/zro_corrector.h"

#include <string.h>

#include <new>

#include "corrector/corrector.h"

namespace zro {
namespace {

/// The C storage behind the C++ interface.
class CStorage final : public Storage {
 public:
  explicit CStorage(const zro_storage* storage) : storage_(storage) {}
  bool Read(int slot, std::uint8_t* out, std::size_t size) override {
    return storage_->read(storage_->context, slot, out, size);
  }
  bool Write(int slot, const std::uint8_t* bytes, std::size_t size) override {
    return storage_->write(storage_->context, slot, bytes, size);
  }

 private:
  const zro_storage* storage_;
};

struct State {
  State(const Config& config, const zro_storage* c_storage)
      : storage(c_storage), corrector(config, c_storage == nullptr ? nullptr : &storage) {}
  CStorage storage;
  Corrector corrector;
};

static_assert(sizeof(State) <= sizeof(zro_corrector) && alignof(State) <= alignof(zro_corrector));
static_assert(ZRO_SLOT_BYTES == Store::kSlotBytes);
// What crosses the border is copied byte by byte.
static_assert(sizeof(Sample) == sizeof(zro_sample) &&
              offsetof(Sample, overrun) == offsetof(zro_sample, overrun));
static_assert(sizeof(Output) == sizeof(zro_output) &&
              offsetof(Output, updated) == offsetof(zro_output, updated));
static_assert(sizeof(Event) == sizeof(zro_event) &&
              offsetof(Event, value) == offsetof(zro_event, value));

Corrector& In(zro_corrector* corrector) {
  return std::launder(reinterpret_cast<State*>(corrector))->corrector;
}

}  // namespace
}  // namespace zro

void zro_init(zro_corrector* corrector, float sample_hz, float noise_density_dps_per_rthz,
              const zro_storage* storage) {
  const zro::Config config = zro::ConfigFor(sample_hz, noise_density_dps_per_rthz);
  auto* state = new (corrector->opaque) zro::State(config, storage);
  state->corrector.Boot();
}

void zro_set_date(zro_corrector* corrector, uint16_t days) { zro::In(corrector).SetDate(days); }

bool zro_add_factory_entry(zro_corrector* corrector, float temp_degc, const float zro_dps[3],
                           float sigma_dps) {
  return zro::In(corrector).AddFactoryEntry(temp_degc, zro_dps, sigma_dps);
}

void zro_step(zro_corrector* corrector, const zro_sample* sample, zro_output* out) {
  zro::Sample in;
  memcpy(&in, sample, sizeof in);
  const zro::Output result = zro::In(corrector).Step(in);
  memcpy(out, &result, sizeof result);
}

bool zro_pop_event(zro_corrector* corrector, zro_event* out) {
  zro::Event event;
  if (!zro::In(corrector).PopEvent(&event)) return false;
  memcpy(out, &event, sizeof event);
  return true;
}

bool zro_commit(zro_corrector* corrector) { return zro::In(corrector).Commit(); }

bool zro_restore_factory(zro_corrector* corrector) { return zro::In(corrector).RestoreFactory(); }
