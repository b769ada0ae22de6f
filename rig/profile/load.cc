#include <fmt/format.h>

#include <algorithm>

#include "core/toml_reader.h"
#include "rig/profile/actions.h"
#include "rig/profile/expectations.h"
#include "rig/profile/limits.h"
#include "rig/profile/plan.h"
#include "rig/profile/profile.h"

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

void CheckNeeds(const Needs& needs, const Action& action, TableReader reader) {
  const std::optional<double> to_degc = SetPointOf(action);
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

/// Every step alone may be short enough; together they end, too.
void CheckLength(const Profile& profile, const Station& station, const std::vector<Place>& places,
                 Diagnostics* diagnostics) {
  const double longest_s = DurationRange().high;
  const std::vector<double> ends_s = StepEndsS(profile, station.model.ambient_degc);
  for (std::size_t i = 0; i < profile.steps.size(); ++i) {
    if (ends_s[i + 1] <= longest_s) continue;
    diagnostics->Add(places[i], fmt::format("with this step the profile takes {:.1f} days or more; "
                                            "seven are the most",
                                            ends_s[i + 1] / 86400));
    return;
  }
}

void ReadSteps(TableReader* file, const Station& station, Profile* profile) {
  std::optional<double> degc;  // last set point, unknown before the first
  std::vector<Place> places;
  for (TableReader& reader : file->Tables("step")) {
    const std::size_t errors = file->diagnostics()->size();
    std::optional<Action> action = ReadAction(&reader, station);
    // Half-read values would only breed follow-on errors.
    if (file->diagnostics()->size() != errors) action.reset();
    std::vector<Stimulus> with = ReadStimuli(&reader, station, action, degc);
    reader.RefuseOtherKeys();
    if (reader.keys().empty()) reader.Complain("", "this [[step]] does nothing");
    if (!action) degc.reset();
    if (!action) continue;
    CheckNeeds(profile->needs, *action, reader);
    if (SetPointOf(*action)) degc = SetPointOf(*action);
    profile->steps.push_back({*action, std::move(with), reader.place().line});
    places.push_back(reader.place());
  }
  CheckLength(*profile, station, places, file->diagnostics());
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
