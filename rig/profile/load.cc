#include <fmt/format.h>

#include <algorithm>

#include "rig/profile/actions.h"
#include "rig/profile/expectations.h"
#include "rig/profile/profile.h"
#include "rig/station/toml_reader.h"

namespace zrobench {
namespace {

void ReadNeeds(TableReader reader, const Station& station, Needs* needs) {
  double degc = 0;
  if (reader.Number("min_degc", &degc, SetPointRange(station))) needs->min_degc = degc;
  if (reader.Number("max_degc", &degc, SetPointRange(station))) needs->max_degc = degc;
  reader.Flag("speaker", &needs->speaker);
  reader.Flag("power", &needs->power);
  reader.RefuseOtherKeys();
  if (needs->min_degc && needs->max_degc && *needs->min_degc >= *needs->max_degc) {
    reader.Complain("min_degc", fmt::format("min_degc = {} is not below max_degc = {}",
                                            *needs->min_degc, *needs->max_degc));
  }
  if (needs->speaker && station.speaker.empty()) {
    reader.Complain("speaker", fmt::format("station {} has no speaker", station.path.string()));
  }
  if (needs->power && station.power.empty()) {
    reader.Complain(
        "power", fmt::format("station {} cannot switch the board's supply", station.path.string()));
  }
}

std::optional<double> SetPointOf(const Action& action) {
  if (const Soak* soak = std::get_if<Soak>(&action)) return soak->to_degc;
  if (const Ramp* ramp = std::get_if<Ramp>(&action)) return ramp->to_degc;
  return std::nullopt;
}

// A stimulus that never comes would make a run that proves nothing.
void CheckStart(const Step& step, std::optional<double> from_degc, const Stimulus& stimulus,
                TableReader reader) {
  const std::optional<double> to_degc = SetPointOf(step.action);
  if (stimulus.at_degc && !to_degc) {
    reader.Complain("at_degc", "only a soak or a ramp passes a temperature; use at_s");
  }
  if (stimulus.at_degc && to_degc && from_degc) {
    const auto [low, high] = std::minmax(*from_degc, *to_degc);
    if (*stimulus.at_degc < low || *stimulus.at_degc > high) {
      reader.Complain("at_degc", fmt::format("at_degc = {} is not passed on the way from {} to {}",
                                             *stimulus.at_degc, *from_degc, *to_degc));
    }
  }
  const Hold* hold = std::get_if<Hold>(&step.action);
  if (hold && stimulus.at_s && *stimulus.at_s >= hold->for_s) {
    reader.Complain("at_s", fmt::format("at_s = {} is after the hold's end at {} s", *stimulus.at_s,
                                        hold->for_s));
  }
}

void CheckNeeds(const Needs& needs, const Step& step, TableReader reader) {
  const std::optional<double> to_degc = SetPointOf(step.action);
  if (!to_degc) return;
  if (needs.max_degc && *to_degc > *needs.max_degc) {
    reader.Complain(
        "", fmt::format("{} degC is above max_degc = {} of [needs]", *to_degc, *needs.max_degc));
  }
  if (needs.min_degc && *to_degc < *needs.min_degc) {
    reader.Complain(
        "", fmt::format("{} degC is below min_degc = {} of [needs]", *to_degc, *needs.min_degc));
  }
}

void ReadSteps(TableReader* file, const Station& station, Profile* profile) {
  std::optional<double> degc;  // last set point, unknown before the first
  for (TableReader& reader : file->Tables("step")) {
    const std::optional<Action> action = ReadAction(&reader, station);
    const bool all_read = action.has_value();
    Step step{action.value_or(Action{}), ReadStimuli(&reader, station), reader.place().line};
    reader.RefuseOtherKeys();
    if (reader.keys().empty()) reader.Complain("", "this [[step]] does nothing");
    if (!all_read) continue;
    CheckNeeds(profile->needs, step, reader);
    const std::vector<TableReader> with = reader.Tables("with");
    for (std::size_t i = 0; i < std::min(with.size(), step.with.size()); ++i) {
      CheckStart(step, degc, step.with[i], with[i]);
    }
    if (SetPointOf(*action)) degc = SetPointOf(*action);
    profile->steps.push_back(std::move(step));
  }
}

void ReadFile(TableReader file, const Station& station, Profile* profile) {
  double schema = 1;
  file.Number("schema", &schema, Range::Between(1, 1));
  file.Text("name", &profile->name);
  file.Text("about", &profile->about);
  file.Require({"schema", "name", "step"});
  ReadNeeds({file.Table("needs").table(), "[needs]", file.diagnostics()}, station, &profile->needs);
  ReadSteps(&file, station, profile);
  for (TableReader& reader : file.Tables("expect")) {
    std::optional<Expectation> expectation = ReadExpectation(&reader);
    if (expectation) profile->expects.push_back(std::move(*expectation));
  }
  file.RefuseOtherKeys();
}

}  // namespace

Result<Profile> LoadProfile(const std::filesystem::path& path, const Station& station) {
  Result<TomlFile> file = ReadToml(path);
  if (!file) return tl::unexpected(file.error());
  Diagnostics diagnostics(path.string());
  Profile profile;
  profile.path = path;
  ReadFile(TableReader(&file->root, "a profile", &diagnostics), station, &profile);
  profile.text = std::move(file->text);
  if (!diagnostics.empty()) return tl::unexpected(diagnostics.error());
  return profile;
}

}  // namespace zrobench
