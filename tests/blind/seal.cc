#include "tests/blind/seal.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace zrobench::blind {
namespace {

using Json = nlohmann::ordered_json;

Json EffectJson(const Effect& effect) {
  const Kind& kind = KindOf(effect.id);
  Json value = effect.strength;
  if (ActsOnEachAxis(kind)) {
    value = Json::array();
    for (const double axis : effect.axes) value.push_back(effect.strength * axis);
  }
  Json parameters;
  parameters[std::string(kind.strength_name)] = {{"value", value}, {"unit", kind.unit}};
  for (std::size_t i = 0; i < effect.shape.size(); ++i) {
    parameters[std::string(kind.shapes[i].name)] = {{"value", effect.shape[i]}};
  }
  return {{"id", effect.id}, {"parameters", parameters}};
}

Json HiddenJson(const Hidden& hidden) {
  Json json = EffectJson(hidden.effect);
  json["lambda"] = hidden.lambda;
  json["nearest"] = hidden.nearest.id;
  json["nearest_noncentrality"] = hidden.nearest.noncentrality;
  return json;
}

}  // namespace

std::string LabelText(const HiddenCase& made, std::string_view name) {
  Json label = {{"schema", 1}, {"case", name}, {"class", made.order.kind}};
  label["effects"] = Json::array();
  for (const Hidden& hidden : made.hidden) label["effects"].push_back(HiddenJson(hidden));
  label["joint_lambda"] = made.joint_lambda;
  label["cosine"] = made.cosine;
  label["channels"] = made.channels;
  label["intervals_s"] = Json::object();
  for (std::size_t run = 0; run < made.intervals_s.size(); ++run) {
    label["intervals_s"][fmt::format("run-{}", run + 1)] = made.intervals_s[run];
  }
  label["structural_lambda"] = made.structural_lambda;
  label["structural"] = Json::array();
  for (const Effect& effect : made.structural) label["structural"].push_back(EffectJson(effect));
  return label.dump(1) + "\n";
}

std::string Nonce(Draw draw) {
  std::string nonce;
  for (int word = 0; word < 4; ++word) nonce += fmt::format("{:016x}", draw.Bits());
  return nonce;
}

std::string SealOf(std::string_view label, std::string_view nonce) {
  const std::string both = std::string(label) + std::string(nonce);
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int length = 0;
  if (EVP_Digest(both.data(), both.size(), digest.data(), &length, EVP_sha256(), nullptr) != 1) {
    throw std::runtime_error("SHA-256 is not available in libcrypto");
  }
  std::string hex;
  for (unsigned int i = 0; i < length; ++i) hex += fmt::format("{:02x}", digest[i]);
  return hex;
}

}  // namespace zrobench::blind
