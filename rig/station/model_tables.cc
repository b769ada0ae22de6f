#include "rig/station/model_tables.h"

#include <fmt/format.h>

#include <algorithm>

namespace zrobench {
namespace {

// Wide enough for a chip on foil and for a climate chamber: these catch slips of units, not taste.
const Range kTemperature = Range::Between(-100, 300);
const Range kCapacity = Range::Between(1e-3, 1e6);
const Range kPower = Range::Between(0, 1e5);
const Range kConductance = Range::Between(0, 1e4);
const Range kResolution = Range::Between(0, 10);

TableReader Section(TableReader* model, std::string_view key) {
  const TableReader table = model->Table(key);
  return {table.table(), fmt::format("[model.{}]", key), model->diagnostics()};
}

void ReadAmbient(TableReader reader, physics::Model* model) {
  reader.Number("degc", &model->ambient_degc, kTemperature);
  reader.RefuseOtherKeys();
}

void ReadPlate(TableReader reader, physics::PlateModel* plate) {
  reader.Number("heat_capacity_j_per_k", &plate->heat_capacity_j_per_k, kCapacity);
  reader.Number("heater_w", &plate->heater_w, kPower);
  reader.Number("cooler_w", &plate->cooler_w, kPower);
  reader.Number("to_ambient_w_per_k", &plate->to_ambient_w_per_k, kConductance);
  reader.Number("resolution_degc", &plate->resolution_degc, kResolution);
  reader.RefuseOtherKeys();
}

void ReadBoard(TableReader reader, std::optional<physics::BoardModel>* board) {
  if (!reader.present()) return board->reset();
  board->emplace();
  reader.Number("heat_capacity_j_per_k", &(*board)->heat_capacity_j_per_k, kCapacity);
  reader.Number("to_plate_w_per_k", &(*board)->to_plate_w_per_k, Range::Between(1e-6, 1e4));
  reader.Number("to_ambient_w_per_k", &(*board)->to_ambient_w_per_k, kConductance);
  reader.RefuseOtherKeys();
}

void ReadPackage(TableReader reader, std::optional<physics::PackageModel>* package) {
  if (!reader.present()) return package->reset();
  package->emplace();
  reader.Number("time_constant_s", &(*package)->time_constant_s, Range::Between(1e-3, 1e4));
  reader.Number("resolution_degc", &(*package)->resolution_degc, kResolution);
  reader.RefuseOtherKeys();
}

void ReadGyro(TableReader reader, std::optional<physics::GyroModel>* gyro) {
  if (!reader.present()) return gyro->reset();
  gyro->emplace();
  reader.Number("reference_degc", &(*gyro)->reference_degc, kTemperature);
  reader.Number("noise_density_dps_per_rthz", &(*gyro)->noise_density_dps_per_rthz,
                Range::Between(0, 10));
  reader.Number("flicker_dps", &(*gyro)->flicker_dps, Range::Between(0, 10));
  constexpr std::string_view kKeys[] = {"zro_x_dps", "zro_y_dps", "zro_z_dps"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<double> cubic;
    if (!reader.Numbers(kKeys[axis], &cubic, Range::Between(-1000, 1000), 1, 4)) continue;
    (*gyro)->zro_dps[axis] = {};  // a shorter list is a polynomial of lower degree
    std::copy(cubic.begin(), cubic.end(), (*gyro)->zro_dps[axis].begin());
  }
  reader.RefuseOtherKeys();
}

void ReadAccel(TableReader reader, physics::AccelModel* accel) {
  reader.Number("noise_density_g_per_rthz", &accel->noise_density_g_per_rthz, Range::Between(0, 1));
  reader.RefuseOtherKeys();
}

void ReadSpeaker(TableReader reader, physics::SpeakerModel* speaker) {
  reader.Number("pa_per_v", &speaker->pa_per_v, Range::Between(1e-6, 1e3));
  reader.RefuseOtherKeys();
}

// Which parameters a term has is the physics' business; here they only have to be numbers.
void ReadTerm(TableReader reader, physics::TermParameters* parameters) {
  for (const toml::key* key : reader.keys()) {
    const std::string name(key->str());
    std::vector<double> values(1);
    const bool list = reader.IsArray(name);
    const bool good = list ? reader.Numbers(name, &values, Range::Any(), 1, 64)
                           : reader.Number(name, &values[0], Range::Any());
    if (good) (*parameters)[name] = values;
  }
}

}  // namespace

void ReadModel(TableReader reader, physics::Model* model) {
  reader.Texts("terms", &model->terms);
  ReadAmbient(Section(&reader, "ambient"), model);
  ReadPlate(Section(&reader, "plate"), &model->plate);
  ReadBoard(Section(&reader, "board"), &model->board);
  ReadPackage(Section(&reader, "package"), &model->package);
  ReadGyro(Section(&reader, "gyro"), &model->gyro);
  ReadAccel(Section(&reader, "accel"), &model->accel);
  ReadSpeaker(Section(&reader, "speaker"), &model->speaker);
  TableReader terms = Section(&reader, "term");
  for (const toml::key* key : terms.keys()) {
    const std::string id(key->str());
    const TableReader term = terms.Table(id);
    if (term.present()) ReadTerm(term, &model->term[id]);
  }
  reader.RefuseOtherKeys();
}

}  // namespace zrobench
