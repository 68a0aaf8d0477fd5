// SPDX-License-Identifier: Apache-2.0
#include "sim/study/sealed.hpp"

#include <OpenImageIO/hash.h>
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string_view>

#include "sim/system/file.hpp"

namespace halfway::study {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* c_checksum = "checksum";

std::string checksum(std::string_view bytes) {
  constexpr unsigned long long c_seed = 0;  // same seed as xxh64sum
  return fmt::format("{:016x}", OIIO::xxhash::XXH64(bytes.data(), bytes.size(), c_seed));
}

}  // namespace

Result<std::string> checksum_of(const std::filesystem::path& file) {
  const auto bytes = read_file(file);
  if (!bytes) return bytes.error();
  return checksum(*bytes);
}

std::string sealed(Json object) {
  object[c_checksum] = checksum(object.dump());
  return object.dump(2) + "\n";
}

std::optional<Json> unsealed(const std::string& text) {
  Json object = Json::parse(text, nullptr, false);
  if (!object.is_object()) return {};
  object.erase(c_checksum);
  if (sealed(object) != text) return {};
  return object;
}

}  // namespace halfway::study
