// SPDX-License-Identifier: Apache-2.0
// Frames of the page of `make live` in headless Chromium.
#include <fmt/format.h>
#include <unistd.h>

#include "sim/extras/bench/measurements.hpp"
#include "sim/extras/live/live_page.hpp"
#include "sim/files/headless_browser.hpp"
#include "sim/os/file.hpp"

namespace halfway {
namespace {

constexpr const char* c_browser_scene = "spheres";
constexpr FrameSize c_browser_size{640, 480};
constexpr int c_browser_repetitions = 5;
constexpr unsigned c_turn_seconds = 4;  // the page's rate is that of the last two seconds

// Statistics of one shader on the page: medians of the repetitions.
struct PageTimes {
  std::vector<double> first, setup, golden, hardware, alone, rate;
};

void turn(HeadlessBrowser& browser) {
  browser.evaluate("document.getElementById('turning').click()");
  ::sleep(c_turn_seconds);
}

double number(HeadlessBrowser& browser, const std::string& expression) {
  const auto value = browser.evaluate(expression);
  if (!value.is_number()) throw Failure{{ExitCode::differs, "the page of make live has no " + expression}};
  return value.get<double>();
}

// Opens the page afresh: first picture, frames on all workers, frames on one worker.
void measure(const std::filesystem::path& page, Shader shader, PageTimes& times) {
  const auto scratch = must(TemporaryFolder::make(std::filesystem::temp_directory_path()));
  HeadlessBrowser browser(scratch.path());
  browser.open(fmt::format("{}#scene={}.toml&shader={}&size={}x{}", page.string(), c_browser_scene,
                           to_string(shader), c_browser_size.width, c_browser_size.height));
  if (!browser.becomes_true("halfwayIsStill()"))
    throw Failure{{ExitCode::differs, "the page of make live draws nothing"}};
  times.first.push_back(number(browser, "firstFrameAt"));
  turn(browser);
  times.rate.push_back(number(browser, "framesPerSecond()"));
  browser.evaluate("workers.splice(1).forEach(({ worker }) => worker.terminate())");
  ::sleep(c_turn_seconds);
  times.setup.push_back(number(browser, "last.figures.setup"));
  times.golden.push_back(number(browser, "last.figures.golden + last.figures.compare"));
  times.hardware.push_back(number(browser, "last.figures.hardware"));
  times.alone.push_back(number(browser, "1e6 * last.figures.hardware / last.figures.fragments"));
  if (number(browser, "last.figures.mismatches") != 0)
    throw Failure{{ExitCode::differs, "the page of make live differs from the golden model"}};
}

}  // namespace

void measure_browser(Json& speed) {
  if (HeadlessBrowser::program().empty()) {
    fmt::print(stderr, "no Chromium here: frames in a browser are not measured; apt-get install chromium\n");
    return;
  }
  const std::filesystem::path page = c_scratch / "live.html";
  fmt::print(stderr, "building the page of make live\n");
  live::write_live(
      {.page = page, .scenes = {c_browser_scene}, .meshes = false, .folders = c_folders, .threads = 2});
  Json rows = Json::array();
  for (const Shader shader : c_shaders) {
    PageTimes times;
    for (int repetition = 0; repetition < c_browser_repetitions; ++repetition) {
      fmt::print(stderr, "{} in a browser: {} of {}\n", to_string(shader), repetition + 1,
                 c_browser_repetitions);
      measure(page, shader, times);
    }
    rows.push_back({to_string(shader), figure(median(times.first)), figure(median(times.setup)),
                    figure(median(times.golden)), figure(median(times.hardware)), figure(median(times.alone)),
                    figure(median(times.rate))});
  }
  speed["browser"] = {{"scene", c_browser_scene},
                      {"width", c_browser_size.width},
                      {"height", c_browser_size.height},
                      {"repetitions", c_browser_repetitions},
                      {"rows", rows}};
}

}  // namespace halfway
