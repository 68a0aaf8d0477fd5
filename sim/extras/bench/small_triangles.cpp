// SPDX-License-Identifier: Apache-2.0
// Clocks per fragment where triangles cover few pixels.
#include <fmt/format.h>

#include <algorithm>

#include "common/to_integer.hpp"
#include "golden_run/walk_counts.hpp"
#include "sim/extras/bench/measurements.hpp"
#include "sim/run/open_engine.hpp"

namespace halfway {

namespace {

WalkCounts count_walk(const GoldenStream& stream) {
  WalkCounter counter(stream.key);
  counter.add(stream.words);
  return counter.counts();
}

}  // namespace

void measure_small_triangles(Json& speed) {
  constexpr FrameSize c_frame{500, 500};
  std::vector<std::pair<double, Scene>> scenes;
  for (const double wanted : {1.25, 3.0, 10.0, 30.0, 100.0}) {
    // Number of triangles for which each triangle that covers a pixel covers `wanted` pixels.
    double triangles = 1e5;
    for (int i = 0; i < 4; ++i) {
      const GoldenStream all = golden_stream(sphere_scene(to_integer<std::uint64_t>(triangles)), c_frame,
                                             {.shader = Shader::processors});
      triangles *=
          static_cast<double>(all.golden.size()) / static_cast<double>(count_walk(all).headers) / wanted;
      triangles = std::clamp(triangles, 100.0, 1e7);
    }
    scenes.emplace_back(wanted, sphere_scene(to_integer<std::uint64_t>(triangles)));
  }
  Json rows = Json::array();
  for (const Shader shader : c_shaders)
    for (const auto& [wanted, scene] : scenes) {
      const GoldenStream all = golden_stream(scene, c_frame, {.shader = shader});
      const auto engine = must(open_engine(EngineKind::verilator, all.key, c_folders));
      std::vector<Fragment> drawn;
      must(engine->run(all.words, drawn, SIZE_MAX));
      must(engine->finish(drawn, SIZE_MAX));
      if (drawn != all.golden) throw Failure{{ExitCode::differs, "small triangles: the RTL differs"}};
      const WalkCounts walk = count_walk(all);
      Json row = {to_string(shader), scene.triangles.size(),
                  figure(static_cast<double>(walk.pixels) / static_cast<double>(walk.headers))};
      for (const std::uint64_t n :
           {engine->cycles().value(), walk.pixels + walk.lost_to_lines + walk.lost_to_headers,
            walk.lost_to_lines, walk.lost_to_headers, walk.headers,
            shader == Shader::spherical ? std::uint64_t{all.vectors()} - walk.headers : 0, walk.lines,
            walk.empty_lines})
        row.push_back(fmt::format("{:.3f}", static_cast<double>(n) / static_cast<double>(walk.pixels)));
      fmt::print(stderr, "small triangles: {}, {} pixels each: {} clocks per fragment\n", to_string(shader),
                 wanted, row[3].get<std::string>());
      rows.push_back(row);
    }
  speed["small_triangles"] = {{"rows", rows}};
}

}  // namespace halfway
