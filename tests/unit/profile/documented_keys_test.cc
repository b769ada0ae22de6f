// Every key that a loader accepts is documented, and every documented key is accepted. What a
// loader knows is asked of itself: its complaint about a key it has never heard of lists them.
#include <gmock/gmock.h>

#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "core/toml_reader.h"
#include "rig/profile/profile.h"
#include "tests/unit/core/toml_text.h"

namespace zrobench {
namespace {

using Keys = std::set<std::string>;

const std::string kRoot = ZROBENCH_SOURCE_DIR;
const std::string kUnheard = "qqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqq";

std::string ReadAll(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(kRoot + path).rdbuf();
  return text.str();
}

/// Every `word` of a text.
Keys Quoted(const std::string& text) {
  static const std::regex word("`([a-z][a-z0-9_]*)`");
  Keys keys;
  for (std::sregex_iterator i(text.begin(), text.end(), word), end; i != end; ++i) {
    keys.insert((*i)[1]);
  }
  return keys;
}

/// The rows of formats.md's table whose head begins with `head`: name in the first cell -> words
/// quoted in the second.
std::map<std::string, Keys> DocumentedTable(const std::string& head) {
  std::istringstream lines(ReadAll("/docs/formats.md"));
  std::map<std::string, Keys> rows;
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(head)) inside = true;
    if (!inside || line.starts_with(head) || line.starts_with("|---")) continue;
    if (!line.starts_with("| ")) break;
    const std::size_t second = line.find('|', 2) + 1;
    rows[*Quoted(line.substr(0, second)).begin()] =
        Quoted(line.substr(second, line.find('|', second) - second));
  }
  return rows;
}

/// What the complaint about kUnheard in `table` says is known there.
Keys KnownIn(const std::string& message) {
  static const std::regex list(kUnheard + "' is not a key of [^;]*; known: ([^\n]*)");
  std::smatch found;
  if (!std::regex_search(message, found, list)) return {};
  Keys keys;
  std::istringstream words(found[1]);
  for (std::string word; std::getline(words, word, ',');) {
    keys.insert(word.substr(word.find_first_not_of(' ')));
  }
  return keys;
}

Keys KnownToProfile(const std::string& text) {
  const TextFile file("schema = 1\nname = \"p\"\n" + text);
  const Result<Profile> profile = LoadProfile(file.path(), Station());
  return profile ? Keys() : KnownIn(profile.error().message);
}

TEST(DocumentedKeys, OfEveryStep) {
  const Keys no_keys = {"tap", "rotate", "vibrate", "hand_held", "max_tone_s"};  // values, remarks
  const auto documented = DocumentedTable("| step | keys |");
  const Keys kinds = KnownToProfile("[[step]]\n" + kUnheard + " = 1\n");
  EXPECT_GE(documented.size(), 10u);
  for (const auto& [kind, words] : documented) {
    Keys keys;
    for (const std::string& word : words) {
      if (!no_keys.contains(word)) keys.insert(word);
    }
    EXPECT_EQ(KnownToProfile("[[step]]\n" + kind + " = { " + kUnheard + " = 1 }\n"), keys) << kind;
    EXPECT_TRUE(kinds.contains(kind)) << kind;
  }
  for (const std::string& kind : kinds) {
    if (kind == "with" || kind == "confirm") continue;  // not a kind; of a later version
    EXPECT_TRUE(documented.contains(kind)) << kind;
  }
}

TEST(DocumentedKeys, OfEveryStimulus) {
  const Keys known = KnownToProfile("[[step]]\nhold = { for_s = 1 }\nwith = [ { " + kUnheard +
                                    " = 1, at_s = 0 } ]\n");
  const std::string text = ReadAll("/docs/formats.md");
  const std::size_t from = text.find("`with` takes");
  ASSERT_NE(from, text.npos);
  Keys documented = Quoted(text.substr(from, text.find('.', from) - from));
  documented.erase("with");
  EXPECT_EQ(known, documented);
}

TEST(DocumentedKeys, OfEveryCheck) {
  const auto documented = DocumentedTable("| check | keys |");
  Keys names;
  for (const auto& [check, keys] : documented) {
    names.insert(check);
    EXPECT_EQ(KnownToProfile("[[step]]\nhold = { for_s = 1 }\n[[expect]]\n" + check + " = { " +
                             kUnheard + " = 1 }\n"),
              keys)
        << check;
  }
  EXPECT_EQ(KnownToProfile("[[step]]\nhold = { for_s = 1 }\n[[expect]]\n" + kUnheard + " = 1\n"),
            names);
}

TEST(DocumentedKeys, OfAProfileAndItsNeeds) {
  const Keys top = KnownToProfile(kUnheard + " = 1\n[[step]]\nhold = { for_s = 1 }\n");
  EXPECT_EQ(top, (Keys{"schema", "name", "about", "needs", "step", "expect"}));
  const Keys needs =
      KnownToProfile("[needs]\n" + kUnheard + " = 1\n[[step]]\nhold = { for_s = 1 }\n");
  const std::string text = ReadAll("/docs/formats.md");
  for (const std::string& key : needs) {
    EXPECT_NE(text.find("\n" + key + " = "), text.npos) << key << " is not in the example";
  }
}

/// Names of all tables in a file, dotted, the root's being empty; terms have their own list, and
/// runs are named by their files.
void CollectTables(const toml::table& table, const std::string& path,
                   std::map<std::string, Keys>& found) {
  Keys& keys = found[path];
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    keys.insert(name);
    const std::string inner = path.empty() ? name : path + "." + name;
    const bool named_by_user = inner == "model.term" || inner == "recording.started_h";
    if (node.is_table() && !named_by_user) CollectTables(*node.as_table(), inner, found);
  }
}

TEST(DocumentedKeys, OfTheStationAreAllInTheShippedOne) {
  const std::string path = "/profiles/stations/virtual.toml";
  const std::string text = ReadAll(path);
  std::map<std::string, Keys> tables;
  CollectTables(ReadToml(kRoot + path)->root, "", tables);
  EXPECT_GE(tables.size(), 14u);
  for (const auto& [table, keys] : tables) {
    std::string changed = text;
    const std::string line = kUnheard + " = 1";
    if (table.empty()) {
      changed = line + "\n" + text;
    } else if (const auto at = text.find("\n[" + table + "]"); at != text.npos) {
      changed.insert(text.find('\n', at + 1) + 1, line + "\n");
    } else {  // written inline
      const std::string key = table.substr(table.rfind('.') + 1) + " = { ";
      ASSERT_NE(text.find(key), text.npos) << table;
      changed.insert(text.find(key) + key.size(), line + ", ");
    }
    const TextFile file(changed);
    const Result<Station> station = LoadStation(file.path());
    ASSERT_FALSE(station) << table;
    EXPECT_EQ(KnownIn(station.error().message), keys) << "[" << table << "]";
  }
}

}  // namespace
}  // namespace zrobench
