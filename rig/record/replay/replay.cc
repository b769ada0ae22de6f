#include "rig/record/replay/replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "corrector/corrector.h"
#include "rig/record/ram_storage.h"
#include "rig/record/replay/noise_survey.h"
#include "rig/record/replay/replay_files.h"
#include "rig/record/replay/replay_input.h"
#include "rig/record/utc_text.h"

namespace zrobench {
namespace {

/// A boot that the options ask for.
struct PlannedBoot {
  double at_s;
  bool orderly;
};

std::vector<PlannedBoot> PlannedBoots(const ReplayOptions& options) {
  std::vector<PlannedBoot> boots;
  for (double at_s : options.reboot_at_s) boots.push_back({at_s, true});
  for (double at_s : options.cut_at_s) boots.push_back({at_s, false});
  std::stable_sort(boots.begin(), boots.end(),
                   [](const auto& a, const auto& b) { return a.at_s < b.at_s; });
  return boots;
}

/// Times that are none, and outputs that would destroy what is read.
Status CheckOptions(const std::filesystem::path& recording, const ReplayOptions& options) {
  for (const PlannedBoot& boot : PlannedBoots(options)) {
    if (!std::isfinite(boot.at_s)) {
      return Fail(Error::Kind::kConfig, "a reboot or cut wants a time in seconds");
    }
  }
  for (const auto& out : {options.estimates, options.decisions, options.table}) {
    for (const auto& in : {std::optional(recording), options.map, options.factory}) {
      std::error_code absent;
      if (out && in && std::filesystem::equivalent(*out, *in, absent)) {
        return Fail(Error::Kind::kConfig,
                    fmt::format("{}: would be overwritten while it is read", out->string()));
      }
    }
  }
  return {};
}

/// The corrector over one recording.
class ReplayRun final : public ReplaySink {
 public:
  ReplayRun(const ReplayOptions& options, ReplaySummary& summary)
      : options_(options), summary_(summary), planned_(PlannedBoots(options)) {}

  Status Start(const ReplayInput& input) {
    if (input.start_image() && !options_.factory && !storage_.Load(*input.start_image())) {
      return Fail(Error::Kind::kConfig, "the recording's start table is no canonical image");
    }
    Boot();
    if (options_.factory) {
      if (Status status = AddFactoryEntries(*options_.factory, *corrector_); !status) return status;
    }
    if (Status status =
            estimates_.Open(options_.estimates, "t_s,zro_x_dps,zro_y_dps,zro_z_dps,still,updated");
        !status) {
      return status;
    }
    return decisions_.Open(options_.decisions,
                           "t_s,code,temp_degc,zro_x_dps,zro_y_dps,zro_z_dps,wrote,entry");
  }

  bool OnSample(double t_s, const zro::Sample& sample) override {
    if (summary_.samples == 0) first_s_ = t_s;
    zro::Sample seen = sample;
    if (BootIfPlanned(t_s)) seen.elapsed = 1;
    UpdateDate(t_s);
    ++summary_.samples;
    if (seen.elapsed > 1) ++summary_.gaps;
    summary_.duration_s = t_s - first_s_;
    const zro::Output output = corrector_->Step(seen);
    TakeEvents(t_s);
    std::copy_n(output.zro_dps, 3, estimate_dps_);
    if (estimates_.wanted()) {
      estimates_.Line("{:.10g},{},{},{},{},{}", t_s, output.zro_dps[0], output.zro_dps[1],
                      output.zro_dps[2], int{output.still}, int{output.updated});
    }
    return true;
  }
  void OnDate(std::uint16_t days) override {
    if (options_.start) return;  // the option rules
    date_ = days;
    corrector_->SetDate(days);
  }
  void OnBoot() override { Boot(); }
  void OnStore() override { static_cast<void>(corrector_->Commit()); }

  Status Finish() {
    if (summary_.samples == 0) {
      return Fail(Error::Kind::kConfig, "the recording holds no complete sample");
    }
    summary_.final_table = corrector_->table();
    Status status = estimates_.Close();
    if (Status closed = decisions_.Close(); status) status = closed;
    if (status && options_.table) status = WriteTable(*options_.table, summary_.final_table);
    return status;
  }

 private:
  void Boot() {
    corrector_.emplace(summary_.config, &storage_);
    corrector_->Boot();
    corrector_->SetDate(date_);
  }

  bool BootIfPlanned(double t_s) {
    const std::size_t before = next_boot_;
    for (; next_boot_ < planned_.size() && t_s >= planned_[next_boot_].at_s; ++next_boot_) {
      if (planned_[next_boot_].orderly) OnStore();
      Boot();
    }
    summary_.planned_boots = next_boot_;
    return next_boot_ != before;
  }

  void UpdateDate(double t_s) {
    if (!options_.start) return;
    const std::uint16_t days = CanopenDays(*options_.start + FromSeconds(t_s - first_s_).count());
    if (days == date_) return;
    date_ = days;
    corrector_->SetDate(days);
  }

  void TakeEvents(double t_s) {
    zro::Event event{};
    while (corrector_->PopEvent(&event)) {
      ++summary_.decisions[event.code];
      const bool wrote = zro::IsWrite(event.code);
      if (wrote) {
        summary_.errors.Add(event.measured_dps, estimate_dps_);
        summary_.hindsight.Add(double{event.temp_degc}, event.measured_dps);
      }
      if (decisions_.wanted()) WriteDecision(t_s, event, wrote);
    }
  }

  void WriteDecision(double t_s, const zro::Event& event, bool wrote) {
    const int entry = wrote ? corrector_->table().Nearest(event.temp_degc) : -1;
    decisions_.Line("{:.10g},{},{},{},{},{},{},{}", t_s, int{static_cast<std::uint8_t>(event.code)},
                    event.temp_degc, event.measured_dps[0], event.measured_dps[1],
                    event.measured_dps[2], int{wrote}, entry < 0 ? "" : std::to_string(entry));
  }

  const ReplayOptions& options_;
  ReplaySummary& summary_;
  std::vector<PlannedBoot> planned_;
  std::size_t next_boot_ = 0;
  RamStorage storage_;
  std::optional<zro::Corrector> corrector_;
  CsvFile estimates_, decisions_;
  std::uint16_t date_ = 0;
  double first_s_ = 0;
  float estimate_dps_[3] = {};  ///< of the sample before
};

/// Sample rate and noise density are the data's own; all else as shipped.
Status Configure(ReplayInput& input, ReplaySummary& summary) {
  const zro::Config defaults;
  const double hz = std::min(input.sample_hz(), std::numeric_limits<std::uint16_t>::max() / 5.0);
  NoiseSurvey survey(hz, defaults.limits.still_sigma_g);
  if (Status status = input.Feed(survey); !status) return status;
  summary.noise_from_data = survey.density_dps_per_rthz().has_value();
  summary.config = zro::ConfigFor(
      static_cast<float>(hz),
      survey.density_dps_per_rthz().value_or(defaults.gyro_noise_density_dps_per_rthz));
  return {};
}

}  // namespace

Result<ReplaySummary> Replay(const std::filesystem::path& recording, const ReplayOptions& options) {
  if (Status status = CheckOptions(recording, options); !status) {
    return tl::unexpected(status.error());
  }
  auto input = OpenReplayInput(recording, options.map);
  if (!input) return tl::unexpected(input.error());
  ReplaySummary summary;
  if (Status status = Configure(**input, summary); !status) return tl::unexpected(status.error());
  ReplayRun run(options, summary);
  Status status = run.Start(**input);
  if (status) status = (*input)->Feed(run);
  if (status) status = run.Finish();
  if (!status) {
    const Error& error = status.error();
    const bool placed = error.message.find(':') != std::string::npos;
    return Fail(error.kind, placed ? error.message : recording.string() + ": " + error.message);
  }
  summary.skipped_rows = (*input)->skipped_rows();
  return summary;
}

}  // namespace zrobench
