// SPDX-License-Identifier: Apache-2.0
// Wrong input comes back as a code and a text, from a program in C++.
#include <halfway.h>

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

namespace {

using Scene = std::unique_ptr<halfway_scene, decltype(&halfway_free_scene)>;

int wrong = 0;

void expect(const halfway_error& error, const std::string& text) {
  if (error.code == HALFWAY_BAD_INPUT && std::string(error.text).find(text) != std::string::npos) return;
  std::printf("got code %d, '%s'; expected '%s'\n", error.code, error.text, text.c_str());
  ++wrong;
}

}  // namespace

int main() {
  halfway_error error;
  const Scene none(halfway_load_scene("missing.obj", nullptr, &error), halfway_free_scene);
  expect(error, "missing.obj: no such file");
  const Scene broken(halfway_parse_scene("[camera\n", "my.toml", &error), halfway_free_scene);
  expect(error, "my.toml:1: ");
  const double corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::uint32_t far_corner[] = {0, 1, 3};
  const halfway_mesh mesh = {corners, nullptr, 3, far_corner, 1, nullptr};
  const Scene outside(halfway_make_scene(&mesh, &error), halfway_free_scene);
  expect(error, "triangle 0 has vertex 3 of 3");
  if (none || broken || outside) ++wrong;
  if (wrong == 0) std::puts("errors: passed");
  return wrong;
}
