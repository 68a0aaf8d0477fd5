// SPDX-License-Identifier: Apache-2.0
// Chromium without a window, driven by its DevTools protocol over a pair of pipes: no port, no driver.
#pragma once

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sim/system/file.hpp"
#include "sim/system/subprocess.hpp"

namespace halfway::report {

/// For tests: what goes wrong is thrown.
class HeadlessBrowser {
 public:
  using Json = nlohmann::json;

  /// Empty where there is none in PATH.
  static std::string program() {
    for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
      if (!find_program(name).empty()) return name;
    return {};
  }

  explicit HeadlessBrowser(const std::filesystem::path& scratch) {
    // Its descriptors 3 and 4 are the pipes: ends of ours that lie there already would be closed by the copy.
    std::array<int, 2> to_it{}, from_it{};
    if (pipe2(to_it.data(), O_CLOEXEC) != 0 || pipe2(from_it.data(), O_CLOEXEC) != 0)
      throw std::runtime_error("pipe2 failed");
    const int its_input = fcntl(to_it[0], F_DUPFD_CLOEXEC, 10);
    const int its_output = fcntl(from_it[1], F_DUPFD_CLOEXEC, 10);
    close(to_it[0]);
    close(from_it[1]);
    write_ = to_it[1];
    read_ = from_it[0];
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, its_input, 3);
    posix_spawn_file_actions_adddup2(&actions, its_output, 4);
    posix_spawn_file_actions_addopen(&actions, 2, (scratch / "browser.log").c_str(), O_WRONLY | O_CREAT,
                                     0644);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    std::vector<std::string> arguments = {program(),
                                          "--headless",
                                          "--no-sandbox",
                                          "--disable-gpu",
                                          "--disable-dev-shm-usage",
                                          "--disable-background-networking",
                                          "--disable-component-update",
                                          "--no-first-run",
                                          "--user-data-dir=" + (scratch / "profile").string(),
                                          "--remote-debugging-pipe",
                                          "about:blank"};
    std::vector<char*> words;
    for (std::string& word : arguments) words.push_back(word.data());
    words.push_back(nullptr);
    const int error = posix_spawnp(&process_, words[0], &actions, &attributes, words.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    close(its_input);
    close(its_output);
    if (error != 0) throw std::runtime_error("cannot start " + arguments[0]);
    const Json target = send("Target.createTarget", {{"url", "about:blank"}});
    session_ =
        send("Target.attachToTarget", {{"targetId", target["targetId"]}, {"flatten", true}})["sessionId"];
    for (const char* domain : {"Page", "Runtime", "Log", "Network"}) send(std::string(domain) + ".enable");
  }
  ~HeadlessBrowser() {
    close(write_);
    close(read_);
    if (process_ > 0) {
      kill(-process_, SIGKILL);  // its own process group: it and what it started
      waitpid(process_, nullptr, 0);
    }
  }
  HeadlessBrowser(const HeadlessBrowser&) = delete;
  HeadlessBrowser& operator=(const HeadlessBrowser&) = delete;

  /// Sends a command, and gives its result.
  Json send(const std::string& method, Json params = Json::object()) {
    Json command = {{"id", ++last_}, {"method", method}, {"params", std::move(params)}};
    if (!session_.empty()) command["sessionId"] = session_;
    const std::string text = command.dump() + '\0';
    for (std::size_t at = 0; at < text.size();) {
      const ssize_t count = write(write_, text.data() + at, text.size() - at);
      if (count <= 0) throw std::runtime_error("the browser went away");
      at += static_cast<std::size_t>(count);
    }
    for (;;) {
      Json message = receive();
      if (message.value("id", 0) != last_) {
        note(message);
        continue;
      }
      if (message.contains("error")) throw std::runtime_error(method + ": " + message["error"].dump());
      return message["result"];
    }
  }

  /// The value of an expression, of a promise what it comes to.
  Json evaluate(const std::string& expression) {
    const Json result = send("Runtime.evaluate",
                             {{"expression", expression}, {"awaitPromise", true}, {"returnByValue", true}});
    if (result.contains("exceptionDetails"))
      throw std::runtime_error(expression + ": " + result["exceptionDetails"].dump());
    return result["result"].value("value", Json());
  }
  /// Waits until an expression is true.
  bool becomes_true(const std::string& expression) {
    for (int i = 0; i < 200; ++i) {
      if (evaluate("Boolean(" + expression + ")") == true) return true;
      usleep(50'000);
    }
    return false;
  }

  void open(const std::filesystem::path& page) {
    send("Page.navigate", {{"url", "file://" + page.string()}});
    if (!becomes_true("location.protocol === 'file:' && document.readyState === 'complete'"))
      throw std::runtime_error("the page does not load");
  }
  void resize(int width, int height) {
    send("Emulation.setDeviceMetricsOverride",
         {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", false}});
  }
  void prefer(const std::string& scheme) {
    send("Emulation.setEmulatedMedia",
         {{"features", {{{"name", "prefers-color-scheme"}, {"value", scheme}}}}});
  }
  void mouse(const std::string& type, double x, double y) {
    send("Input.dispatchMouseEvent", {{"type", type},
                                      {"x", x},
                                      {"y", y},
                                      {"button", "left"},
                                      {"buttons", type == "mouseReleased" ? 0 : 1},
                                      {"clickCount", 1}});
  }
  /// `touchStart` and `touchMove` with all fingers that are down; the browser is told first that it has a
  /// touch screen.
  void touch(const std::string& type, const std::vector<std::pair<double, double>>& fingers) {
    Json points = Json::array();
    for (std::size_t i = 0; i < fingers.size(); ++i)
      points.push_back({{"id", i}, {"x", fingers[i].first}, {"y", fingers[i].second}});
    send("Emulation.setTouchEmulationEnabled", {{"enabled", true}, {"maxTouchPoints", 5}});
    send("Input.dispatchTouchEvent", {{"type", type}, {"touchPoints", points}});
  }
  void press(const std::string& key) {
    Json event = {{"type", "keyDown"}, {"key", key}, {"code", key}};
    if (key.size() == 1) event["text"] = key;
    if (key == "Enter") event.update({{"text", "\r"}, {"windowsVirtualKeyCode", 13}});
    if (key == "Escape") event["windowsVirtualKeyCode"] = 27;
    if (key == "ArrowLeft") event["windowsVirtualKeyCode"] = 37;
    if (key == "ArrowRight") event["windowsVirtualKeyCode"] = 39;
    send("Input.dispatchKeyEvent", event);
    event["type"] = "keyUp";
    event.erase("text");
    send("Input.dispatchKeyEvent", event);
  }

  /// What the console said of errors and warnings, and exceptions.
  std::vector<std::string> complaints;
  /// Of everything but the page itself and data.
  std::vector<std::string> requests;

 private:
  Json receive() {
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    for (;;) {
      if (const std::size_t end = buffer_.find('\0'); end != std::string::npos) {
        const std::string message = buffer_.substr(0, end);
        buffer_.erase(0, end + 1);
        return Json::parse(message);
      }
      pollfd ready{read_, POLLIN, 0};
      if (std::chrono::steady_clock::now() > until) throw std::runtime_error("the browser does not answer");
      if (poll(&ready, 1, 1000) <= 0) continue;
      std::array<char, 1 << 16> bytes{};
      const ssize_t count = read(read_, bytes.data(), bytes.size());
      if (count <= 0) throw std::runtime_error("the browser went away");
      buffer_.append(bytes.data(), static_cast<std::size_t>(count));
    }
  }
  void note(const Json& message) {
    const std::string method = message.value("method", "");
    const Json params = message.value("params", Json::object());
    if (method == "Runtime.exceptionThrown") complaints.push_back(params.dump());
    if (method == "Log.entryAdded" && params["entry"]["level"] != "info" &&
        params["entry"]["level"] != "verbose")
      complaints.push_back(params.dump());
    if (method == "Runtime.consoleAPICalled" && (params["type"] == "error" || params["type"] == "warning"))
      complaints.push_back(params.dump());
    if (method == "Network.requestWillBeSent") {
      const std::string url = params["request"]["url"];
      if (!url.starts_with("data:") && params.value("type", "") != "Document") requests.push_back(url);
    }
  }

  pid_t process_ = -1;
  int write_ = -1, read_ = -1;
  int last_ = 0;
  std::string session_, buffer_;
};

}  // namespace halfway::report
