#include "rig/station/station.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/toml_reader.h"
#include "rig/station/address.h"
#include "rig/station/model_tables.h"

namespace zrobench {
namespace {

TableReader Section(TableReader* file, std::string_view key) {
  const TableReader table = file->Table(key);
  return {table.table(), fmt::format("[{}]", key), file->diagnostics()};
}

void ReadName(TableReader reader, Station* station) {
  reader.Text("name", &station->name);
  reader.Number("humidity_pct", &station->humidity_pct, Range::Between(0, 100));
  reader.Flag("purge", &station->purge);
  reader.Require({"name"});
  reader.RefuseOtherKeys();
}

void ReadInstruments(TableReader reader, Station* station) {
  if (!reader.present()) return;  // all virtual
  // A bench that names its instruments has those it names: no virtual ones among real ones.
  station->speaker.clear();
  station->power.clear();
  const struct {
    Role role;
    std::string_view key;
    std::string* address;
  } rows[] = {{Role::kPlate, "plate", &station->plate},
              {Role::kSpeaker, "speaker", &station->speaker},
              {Role::kBoard, "board", &station->board},
              {Role::kPower, "power", &station->power},
              {Role::kEnvironment, "environment", &station->environment}};
  for (const auto& row : rows) {
    if (!reader.Text(row.key, row.address)) continue;
    const std::string fault = AddressFault(row.role, *row.address);
    if (!fault.empty()) reader.Complain(row.key, fault);
  }
  reader.Require({"plate", "board"});
  reader.RefuseOtherKeys();
}

void ReadLimits(TableReader reader, StationLimits* limits) {
  const Range temperature = Range::Between(-100, 200);
  reader.Number("min_degc", &limits->min_degc, temperature);
  reader.Number("max_degc", &limits->max_degc, temperature);
  reader.Number("max_rate_degc_per_min", &limits->max_rate_degc_per_min, Range::Between(0.01, 100));
  reader.Number("max_tone_v", &limits->max_tone_v, Range::Between(1e-6, 1000));
  reader.Number("min_tone_hz", &limits->min_tone_hz, Range::Between(0.1, 1e6));
  reader.Number("max_tone_hz", &limits->max_tone_hz, Range::Between(0.1, 1e6));
  reader.Number("max_spl_db", &limits->max_spl_db, Range::Between(0, 194));
  reader.Number("max_tone_s", &limits->max_tone_s, Range::Between(0.1, 86400));
  if (limits->min_degc >= limits->max_degc) {
    reader.Complain("min_degc", fmt::format("min_degc = {} is not below max_degc = {}",
                                            limits->min_degc, limits->max_degc));
  }
  if (limits->min_tone_hz >= limits->max_tone_hz) {
    reader.Complain("min_tone_hz", fmt::format("min_tone_hz = {} is not below max_tone_hz = {}",
                                               limits->min_tone_hz, limits->max_tone_hz));
  }
  reader.RefuseOtherKeys();
}

void ReadCalibration(TableReader reader, StationCalibration* calibration) {
  reader.Text("certificate", &calibration->certificate);
  reader.Number("plate_uncertainty_k2_degc", &calibration->plate_uncertainty_k2_degc,
                Range::Between(0, 10));
  reader.Number("speaker_uncertainty_k2_db", &calibration->speaker_uncertainty_k2_db,
                Range::Between(0, 40));
  reader.RefuseOtherKeys();
}

void ReadController(TableReader reader, VirtualSettings* settings) {
  reader.Number("kp_pct_per_k", &settings->kp_pct_per_k, Range::Between(0, 1e4));
  reader.Number("ki_pct_per_k_s", &settings->ki_pct_per_k_s, Range::Between(0, 1e4));
  reader.Number("rate_limit_degc_per_min", &settings->rate_limit_degc_per_min,
                Range::Between(0, 1e3));
  reader.RefuseOtherKeys();
}

void ReadVirtual(TableReader reader, VirtualSettings* settings) {
  reader.Date("epoch", &settings->epoch);
  reader.Number("sample_hz", &settings->sample_hz, Range::Between(10, 2000));
  if (reader.Number("gyro_range_dps", &settings->gyro_range_dps, Range::Between(125, 4000))) {
    const double code = std::log2(settings->gyro_range_dps / 125);
    if (code != std::floor(code)) {
      reader.Complain("gyro_range_dps", fmt::format("gyro_range_dps = {} is not one of 125, 250, "
                                                    "500, 1000, 2000, 4000",
                                                    settings->gyro_range_dps));
    }
  }
  ReadController(reader.Table("controller"), settings);
  // The table holds 48 entries, and what is learned needs room.
  reader.Numbers("factory_degc", &settings->factory_degc, Range::Between(-40, 125), 0, 16);
  reader.Number("factory_error_dps", &settings->factory_error_dps, Range::Between(0, 10));
  reader.RefuseOtherKeys();
}

void ReadRecording(TableReader reader, RecordingSettings* recording) {
  std::string rows = "mean";
  std::string start = "power_on";
  reader.Choice("rows", &rows, {"mean", "instant"});
  reader.Choice("t0", &start, {"power_on", "unknown"});
  recording->mean_rows = rows == "mean";
  recording->starts_at_power_on = start == "power_on";
  reader.Text("map", &recording->map);
  TableReader started = reader.Table("started_h");
  for (const toml::key* key : started.keys()) {
    started.Number(key->str(), &recording->started_h[std::string(key->str())], Range::AtLeast(0));
  }
  reader.RefuseOtherKeys();
}

void ReadClock(TableReader reader, Station* station) {
  reader.Number("speed", &station->clock_speed, Range::Between(1e-3, 10000));
  reader.RefuseOtherKeys();
}

// `key` is a path as in the file: model.term."acoustic.resonance".q. What is missing there is
// reported at the nearest table above it.
Place PlaceOfPath(const toml::table& root, std::string_view key) {
  const toml::node* node = &root;
  while (!key.empty() && node->is_table()) {
    const bool quoted = key.front() == '"';
    const std::size_t end = quoted ? key.find('"', 1) : key.find('.');
    const toml::node* next = node->as_table()->get(key.substr(quoted, end - quoted));
    if (!next) break;
    node = next;
    if (end == std::string_view::npos) break;
    key.remove_prefix(std::min(key.size(), end + 1 + (quoted ? 1 : 0)));
  }
  return PlaceOf(*node);
}

// What only the physics can tell: unknown terms, their parameters, impossible combinations.
void CheckModel(const toml::table& root, const physics::Model& model, Diagnostics* diagnostics) {
  for (const physics::ModelError& error : physics::FindErrors(model)) {
    diagnostics->Add(PlaceOfPath(root, error.key), error.message);
  }
}

void ReadFile(TableReader file, Station* station) {
  double schema = 1;
  file.Number("schema", &schema, Range::Between(1, 1));
  file.Require({"station"});
  const TableReader name = Section(&file, "station");
  if (name.present()) ReadName(name, station);
  ReadInstruments(Section(&file, "instruments"), station);
  ReadLimits(Section(&file, "limits"), &station->limits);
  ReadCalibration(Section(&file, "calibration"), &station->calibration);
  ReadClock(Section(&file, "clock"), station);
  ReadVirtual(Section(&file, "virtual"), &station->virtual_rig);
  ReadRecording(Section(&file, "recording"), &station->recording);
  ReadModel(Section(&file, "model"), &station->model);
  file.RefuseOtherKeys();
}

}  // namespace

Result<Station> LoadStation(const std::filesystem::path& path) {
  Result<TomlFile> file = ReadToml(path);
  if (!file) return tl::unexpected(file.error());
  Diagnostics diagnostics(path.string());
  Station station;
  station.path = path;
  ReadFile(TableReader(&file->root, "a station file", &diagnostics), &station);
  CheckModel(file->root, station.model, &diagnostics);
  station.text = std::move(file->text);
  if (!diagnostics.empty()) return tl::unexpected(diagnostics.error());
  return station;
}

}  // namespace zrobench
