// SPDX-License-Identifier: Apache-2.0
// Tests of the report's page in a browser, used with mouse, keys and touch.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <memory>

#include "sim/cli/command_test.hpp"
#include "sim/engines/ghdl/test/checkout.hpp"
#include "sim/files/headless_browser.hpp"
#include "sim/files/image.hpp"
#include "sim/os/must.hpp"
#include "sim/study/study.hpp"
#include "sim/study/table.hpp"

namespace halfway::report {
namespace {

using ::testing::IsEmpty;
using Json = nlohmann::json;

class ReportPage : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    ASSERT_FALSE(HeadlessBrowser::program().empty())
        << "no Chromium here: apt-get install chromium, or make test";
    ASSERT_FALSE(find_program("gnuplot").empty()) << "no gnuplot here: apt-get install gnuplot-nox";
    ASSERT_FALSE(find_program("pdftotext").empty())
        << "no pdftotext here: apt-get install poppler-utils, or make test";
    write(
        "figures/figures.json",
        R"([{"id": "quadratic-09", "paper": "quadratic", "number": "figure 9", "caption": "A <sphere> of `lights`",
             "shows": "ours", "pictures": [{"file": "a.svg", "alt": "a line"}],
             "rows": [{"what": "triangles", "published": "168", "measured": "168", "value": 168,
                       "criterion": "the same", "verdict": "agrees", "reason": "", "slow": false}]}])");
    write("figures/a.svg",
          "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 9 9\"><path d=\"M0 0L9 9\"/></svg>");
    make_study();
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"sim", "spheres", "--size", "96x72", "--simulator", "verilator", "--out",
                                   "out"},
          {"report", "--results", "out", "--study", "study", "--figures", "figures", "--out", "page.html",
           "--no-timing"}}) {
      const Outcome outcome = run(command);
      ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    }
    browser_ = std::make_unique<HeadlessBrowser>(here());
    browser_->resize(1440, 900);
    browser_->open(at("page.html"));
    ASSERT_TRUE(browser_->becomes_true("document.querySelector('#frame-viewer .values td')"));
  }

  // A study of five points with one picture, two of them at the same place, as `halfway study` writes it
  // without Yosys and Valgrind.
  void make_study() const {
    study::StudySettings settings;
    settings.scene = c_source_folder / "sim/study/spaces/sphere.toml";
    settings.out = at("study");
    settings.threads = 2;
    settings.folders = c_checkout;
    for (const study::Method method :
         {study::Method::phong, study::Method::gouraud, study::Method::quadratic, study::Method::adaptive})
      settings.points.push_back({.method = method, .size = {160, 120}});
    settings.points.push_back(
        {.method = study::Method::adaptive, .host = {.quadratic = {.threshold = 250}}, .size = {160, 120}});
    const study::Study made = study::run_study(settings);
    write("study/study.csv", study::study_csv(made.provenance, made.records, {}, {}));
  }

  void TearDown() override {
    if (browser_) {
      EXPECT_THAT(browser_->complaints, IsEmpty());
      EXPECT_THAT(browser_->requests, IsEmpty());
      browser_.reset();
    }
  }

  Json evaluate(const std::string& expression) { return browser_->evaluate(expression); }
  std::pair<double, double> middle_of(const std::string& selector) { return browser_->middle_of(selector); }
  void drag(double x0, double x1, double y) { browser_->drag({x0, y}, {x1, y}); }
  void click(double x, double y) { browser_->click(x, y); }
  std::string label() { return evaluate("document.querySelector('#frame-viewer canvas').ariaLabel"); }
  double wipe() {
    return evaluate("document.querySelector('#frame-viewer input').valueAsNumber").get<double>();
  }
  /// The canvas's colour at a position given as parts of its width and height.
  std::vector<int> painted(const std::string& canvas, double x, double y) {
    return evaluate(
               fmt::format("[...{}.getImageData({} * copy.width, {} * copy.height, 1, 1).data.slice(0, 3)]",
                           copy_of(canvas), x, y))
        .get<std::vector<int>>();
  }
  /// A drawing context with a copy of a canvas. Reading the canvas itself would make it slow and cause
  /// warnings in Chromium.
  static std::string copy_of(const std::string& canvas) {
    return fmt::format(
        "(globalThis.shown = document.querySelector('{}'), globalThis.copy = new "
        "OffscreenCanvas(shown.width, "
        "shown.height), globalThis.context = copy.getContext('2d', {{willReadFrequently: true}}), "
        "context.drawImage(shown, 0, 0), context)",
        canvas);
  }
  /// The values that the viewer shows for a layer at the chosen pixel.
  std::vector<int> shown(const std::string& viewer, const std::string& layer) {
    return evaluate(fmt::format("[...document.querySelectorAll('{} [data-layer={}] td')].slice(1).map((c) => "
                                "Number(c.textContent))",
                                viewer, layer))
        .get<std::vector<int>>();
  }
  /// The text of the printed page.
  std::string print() {
    write("coded", browser_->send("Page.printToPDF")["data"].get<std::string>());
    // subprocess output is truncated, so use a file
    EXPECT_THAT(run_as({"sh", "-c", "base64 -d coded >page.pdf && pdftotext page.pdf page.txt"}),
                Ends(0, ::testing::_));
    return text_of("page.txt");
  }
  Frame frame(const std::string& layer) const {
    return must(read_png(at("out/spheres/quadratic") / (layer + ".png")));
  }
  static std::vector<int> pixel(const Frame& frame, std::uint32_t x, std::uint32_t y) {
    const std::size_t at = frame.offset(x, y);
    return {frame.rgb[at], frame.rgb[at + 1], frame.rgb[at + 2]};
  }

  std::unique_ptr<HeadlessBrowser> browser_;
};

TEST_F(ReportPage, FitsPhonesPaperAndDarkMode) {
  evaluate("document.querySelectorAll('details').forEach((d) => d.open = true)");
  for (const int width : {390, 1440}) {
    browser_->resize(width, 844);
    EXPECT_LE(evaluate("document.documentElement.scrollWidth").get<int>(), width);
  }
  // On a phone, the verdict is next to its figure.
  browser_->resize(390, 844);
  EXPECT_LE(evaluate("document.querySelector('.agrees').getBoundingClientRect().right").get<double>(), 390);
  // The contrast of text and background meets WCAG.
  const std::string contrast = R"((() => {
    const light = (rgb) => rgb.match(/[\d.]+/g).slice(0, 3).map((v) => v / 255)
      .map((v) => v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)
      .reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
    const paper = light(getComputedStyle(document.body).backgroundColor);
    return Math.min(...['body', 'a', 'figcaption', 'caption', '.agrees'].map((name) => {
      const ink = light(getComputedStyle(document.querySelector(name)).color);
      return (Math.max(ink, paper) + 0.05) / (Math.min(ink, paper) + 0.05);
    }));
  })())";
  std::vector<std::string> papers;
  for (const char* scheme : {"light", "dark"}) {
    browser_->prefer(scheme);
    EXPECT_GE(evaluate(contrast).get<double>(), 4.5) << scheme;
    papers.push_back(evaluate("getComputedStyle(document.body).backgroundColor"));
  }
  EXPECT_NE(papers[0], papers[1]);
}

TEST_F(ReportPage, PrintsFoldedSections) {
  ASSERT_GT(evaluate("document.querySelectorAll('details').length").get<int>(), 2);
  ASSERT_EQ(evaluate("document.querySelectorAll('details[open]').length"), 0);
  const std::string printed = print();
  // Texts of the papers' figures, the points' table, the effects and a page of tb/.
  for (const char* words : {"Here: ours", "Points of the study", "Effects of spheres",
                            "make bench writes this page", "spheres by the shader quadratic: reference left"})
    EXPECT_NE(printed.find(words), std::string::npos) << words;
  EXPECT_EQ(evaluate("document.querySelectorAll('details[open]').length"), 0);
  // Narrow columns do not break words: a word is printed as often as it occurs on the page.
  const std::string word = "edge_error";
  int whole = 0;
  for (std::size_t at = 0; (at = printed.find(word, at)) != std::string::npos; at += word.size()) ++whole;
  EXPECT_EQ(evaluate("document.querySelector('main').textContent.split('" + word + "').length - 1"), whole);
}

TEST_F(ReportPage, EverythingHasAName) {
  const std::string image = "document.querySelector('img.figure')";
  EXPECT_EQ(evaluate(image + ".getAttribute('width')"), "9");
  EXPECT_EQ(evaluate(image + ".getAttribute('height')"), "9");
  EXPECT_EQ(evaluate("document.querySelector('#figures details code').textContent"), "lights");
  evaluate("document.querySelectorAll('details').forEach((d) => d.open = true)");
  const Json tree = browser_->send("Accessibility.getFullAXTree")["nodes"];
  std::map<std::string, int> seen;
  for (const Json& node : tree) {
    if (node.value("ignored", false)) continue;
    const std::string role = node["role"].value("value", "");
    for (const char* named :
         {"button", "link", "image", "img", "slider", "combobox", "application", "region", "group"})
      if (role == named &&
          (role != "group" || node["properties"].dump().find("focusable") != std::string::npos)) {
        ++seen[role];
        EXPECT_NE(node["name"].value("value", ""), "") << node.dump();
      }
  }
  for (const char* role : {"button", "link", "slider", "combobox", "application", "region"})
    EXPECT_GT(seen[role], 0) << role;
  EXPECT_GT(seen["image"] + seen["img"], 0);
}

TEST_F(ReportPage, WipesAndZoomsToThePngsPixels) {
  const Frame reference = frame("reference"), difference = frame("diff");
  const std::string canvas = "#frame-viewer canvas";
  // It starts with a pixel of a body; no body is at the centre.
  ASSERT_EQ(pixel(reference, 48, 36), pixel(reference, 0, 0));
  EXPECT_NE(shown("#frame-viewer", "reference"), pixel(reference, 0, 0));
  evaluate("{ const s = document.querySelector('#frame-viewer .right'); s.value = 'diff'; s.onchange(); }");
  // Find a pixel in the right half where the two differ, so that moving the wipe over it is visible.
  std::uint32_t x = 55, y = 1;
  const auto differ = [&] { return std::abs(pixel(reference, x, y)[0] - pixel(difference, x, y)[0]) > 40; };
  while (!differ()) {
    if (++x == 85) x = 55, ++y;
    ASSERT_LT(y, 71U);
  }
  const double at_x = (x + 0.5) / 96, at_y = (y + 0.5) / 72;
  EXPECT_EQ(painted(canvas, at_x, at_y), pixel(difference, x, y));
  const auto [mid_x, mid_y] = middle_of(canvas);
  const double width = evaluate("document.querySelector('#frame-viewer canvas').clientWidth");
  EXPECT_EQ(wipe(), 500);
  drag(mid_x, mid_x + 0.48 * width, mid_y);
  EXPECT_NEAR(wipe(), 980, 3);
  EXPECT_EQ(painted(canvas, at_x, at_y), pixel(reference, x, y));
  // With keys: those of the slider, and those of the canvas.
  evaluate("document.querySelector('#frame-viewer input').focus()");
  const double before = wipe();
  browser_->press("ArrowLeft");
  EXPECT_LT(wipe(), before);
  evaluate("document.querySelector('#frame-viewer canvas').focus()");
  for (int i = 0; i < 30; ++i) browser_->press("[");
  EXPECT_NEAR(wipe(), before - 600, 10);
  EXPECT_EQ(painted(canvas, at_x, at_y), pixel(difference, x, y));
  // A click chooses a pixel; the arrow keys continue from it.
  const auto [again_x, again_y] = middle_of(canvas);
  click(again_x + (at_x - 0.5) * width, again_y + (at_y - 0.5) * width * 0.75);
  EXPECT_EQ(shown("#frame-viewer", "reference"), pixel(reference, x, y));
  EXPECT_EQ(shown("#frame-viewer", "diff"), pixel(difference, x, y));
  browser_->press("ArrowLeft");
  EXPECT_EQ(shown("#frame-viewer", "reference"), pixel(reference, x - 1, y));
  // Zooming in keeps that pixel in place and writes its values into it.
  for (int i = 0; i < 6; ++i) browser_->press("+");
  EXPECT_NE(label().find("zoom 64"), std::string::npos);
  for (int i = 0; i < 61; ++i) browser_->press("]");
  // Zoom 64 of 96 pixels: 1.5 pixels are visible across, so the chosen pixel covers the area around its
  // centre.
  const Json colours = evaluate(fmt::format(
      "(() => {{ const d = {}.getImageData(0, 0, copy.width, copy.height).data; const n = {{}}; for (let i = "
      "0; i < "
      "d.length; i += 4) {{ const k = d.slice(i, i + 3).join(); n[k] = (n[k] || 0) + 1; }} return n; }})()",
      copy_of(canvas)));
  const auto chosen = pixel(reference, x - 1, y);
  const std::string name = fmt::format("{}", fmt::join(chosen, ","));
  ASSERT_TRUE(colours.contains(name)) << name;
  const double area = evaluate("copy.width * copy.height").get<double>();
  EXPECT_GT(colours[name].get<double>(), 0.3 * area);
}

TEST_F(ReportPage, TwoFingersZoomAndMove) {
  const Frame reference = frame("reference");
  browser_->resize(390, 844);
  const std::string canvas = "#frame-viewer canvas";
  evaluate(
      "{ const s = document.querySelector('#frame-viewer .right'); s.value = 'reference'; s.onchange(); }");
  // Find a pixel that differs from its neighbours.
  std::uint32_t x = 40, y = 30;
  const auto differ = [&](std::uint32_t other_x, std::uint32_t other_y) {
    return std::abs(pixel(reference, x, y)[0] - pixel(reference, other_x, other_y)[0]) > 8;
  };
  while (!differ(x - 1, y) || !differ(x, y - 1)) {
    if (++x == 56) x = 40, ++y;
    ASSERT_LT(y, 42U);
  }
  const auto [mid_x, mid_y] = middle_of(canvas);
  const double width = evaluate("document.querySelector('#frame-viewer canvas').clientWidth");
  const double scrolled = evaluate("scrollY");
  const double at_x = (x + 0.5) / 96, at_y = (y + 0.5) / 72;
  const double px = mid_x + (at_x - 0.5) * width, py = mid_y + (at_y - 0.5) * width * 0.75;
  const auto two = [&](const char* type, double right, double apart) {
    browser_->touch(type, {{px + right - apart, py}, {px + right + apart, py}});
  };
  two("touchStart", 0, 10);
  for (const double apart : {20.0, 35.0, 50.0}) two("touchMove", 0, apart);
  EXPECT_TRUE(
      browser_->becomes_true("document.querySelector('#frame-viewer canvas').ariaLabel.includes('zoom 5.')"))
      << label();
  // Zoom by five around the pixel between the fingers.
  const double step = 5.0 / 96;
  EXPECT_EQ(painted(canvas, at_x, at_y), pixel(reference, x, y));
  EXPECT_EQ(painted(canvas, at_x - step, at_y), pixel(reference, x - 1, y));
  EXPECT_EQ(painted(canvas, at_x, at_y - step * 96 / 72), pixel(reference, x, y - 1));
  // Moving both fingers to the right moves the picture.
  for (const double right : {10.0, 20.0}) two("touchMove", right, 50);
  const double there = at_x + 20 / width;
  EXPECT_EQ(painted(canvas, there, at_y), pixel(reference, x, y));
  EXPECT_EQ(painted(canvas, there - step, at_y), pixel(reference, x - 1, y));
  browser_->touch("touchEnd", {});
  EXPECT_EQ(evaluate("visualViewport.scale"), 1);
  EXPECT_EQ(evaluate("scrollY").get<double>(), scrolled);
  EXPECT_EQ(wipe(), 500);
  // A single finger chooses a pixel, as before.
  browser_->touch("touchStart", {{px + 20, py}});
  browser_->touch("touchEnd", {});
  EXPECT_EQ(shown("#frame-viewer", "reference"), pixel(reference, x, y));
  // Pinching together shows the whole picture, not less.
  two("touchStart", 0, 60);
  for (const double apart : {30.0, 10.0, 5.0}) two("touchMove", 0, apart);
  EXPECT_NE(label().find("zoom 1."), std::string::npos) << label();
  browser_->touch("touchEnd", {});
}

TEST_F(ReportPage, PointsOpenTheirFrames) {
  const std::string point = ".plot svg a[href='#point-2']";
  const auto [x, y] = middle_of(point);
  const std::string name = evaluate("data.points[2].name");
  EXPECT_NE(name.find("quadratic exact"), std::string::npos);
  const auto is_open = [&] {
    return browser_->becomes_true(
        "document.querySelector('#point').open && document.querySelector('#point .values "
        "[data-layer=frame]')");
  };
  const auto shut = [&] {
    browser_->press("Escape");
    EXPECT_TRUE(browser_->becomes_true("!document.querySelector('#point').open"));
    evaluate("document.querySelector('#point .values').replaceChildren()");
  };
  click(x, y);
  ASSERT_TRUE(is_open());
  EXPECT_EQ(evaluate("document.getElementById('point-name').textContent"), name);
  EXPECT_NE(evaluate("document.getElementById('point-values').textContent")
                .get<std::string>()
                .find("quadratic_shader"),
            std::string::npos);
  // A second point has the same values and the same place; the list offers both.
  const std::string crowd = "document.getElementById('point-crowd')";
  EXPECT_EQ(evaluate(crowd + ".hidden"), false);
  EXPECT_EQ(evaluate("document.querySelectorAll('#point-crowd a[href=\"#point-4\"]').length"), 1);
  // The frame shown is the study's file.
  std::size_t equal = 0;
  for (const auto& file : std::filesystem::directory_iterator(at("study/points"))) {
    if (file.path().extension() != ".png") continue;
    const std::string record = text_of(std::filesystem::path(file.path()).replace_extension(".json"));
    if (record.find('"' + name + '"') == std::string::npos) continue;
    EXPECT_EQ(shown("#point-viewer", "frame"), pixel(must(read_png(file.path())), 80, 60));
    ++equal;
  }
  EXPECT_EQ(equal, 1U);
  evaluate("document.querySelector('#point-crowd a[href=\"#point-4\"]').click()");
  EXPECT_TRUE(
      browser_->becomes_true("document.getElementById('point-name').textContent === data.points[4].name"));
  EXPECT_EQ(evaluate(crowd + ".hidden"), false);
  shut();
  // With keys only: focus, an arrow key to a neighbour, Enter.
  evaluate("document.querySelector(\"" + point + "\").focus()");
  browser_->press("Enter");
  ASSERT_TRUE(is_open());
  EXPECT_EQ(evaluate("document.getElementById('point-name').textContent"), name);
  shut();
  const std::string here = evaluate("document.activeElement.getAttribute('href')");
  EXPECT_EQ(here, "#point-2");
  browser_->press("ArrowRight");
  if (evaluate("document.activeElement.getAttribute('href')") == here) browser_->press("ArrowLeft");
  const std::string there = evaluate("document.activeElement.getAttribute('href')");
  EXPECT_NE(there, here);
  browser_->press("Enter");
  ASSERT_TRUE(is_open());
  EXPECT_EQ(evaluate("document.getElementById('point-name').textContent"),
            evaluate("data.points[" + there.substr(7) + "].name"));
}

}  // namespace
}  // namespace halfway::report
