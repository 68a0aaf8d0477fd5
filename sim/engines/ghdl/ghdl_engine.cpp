// SPDX-License-Identifier: Apache-2.0
#include "sim/engines/ghdl/ghdl_engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <mutex>
#include <numeric>

#include "sim/files/trace.hpp"
#include "sim/os/must.hpp"
#include "sim/os/threads.hpp"

namespace halfway {
namespace {

// Size of a part: this share of all remaining clocks, so more than eight cores bring no gain, but at least
// c_least_part clocks, so that GHDL's start does not dominate.
constexpr std::uint64_t c_share = 8, c_least_part = 2048;
constexpr std::uint64_t c_between_places = 256;  // clocks
constexpr std::size_t c_block = 4096;            // vectors or fragments at a time

void split(const std::filesystem::path& init_file, const std::string& key_name,
           std::span<const std::uint64_t> first_vectors,
           const std::vector<std::filesystem::path>& part_files) {
  auto reader = must(InitFileReader::open(init_file, key_name));
  std::uint64_t at = 0;
  for (std::size_t part = 0; part < part_files.size(); ++part) {
    const std::uint64_t end =
        part + 1 < first_vectors.size() ? first_vectors[part + 1] : std::numeric_limits<std::uint64_t>::max();
    auto writer = must(InitFileWriter::open(part_files[part], key_name, reader.bits()));
    while (at < end) {
      std::vector<std::uint32_t> words;
      const std::size_t count = must(reader.read(words, std::min<std::uint64_t>(c_block, end - at)));
      if (count == 0) break;
      writer.write(words);
      at += count;
    }
    must(writer.commit());
  }
}

void pass_on(const std::filesystem::path& trace_file, const std::string& key_name,
             const Engine::OnDrawn& on_drawn) {
  auto reader = must(TraceReader::open(trace_file, key_name));
  for (std::vector<Fragment> fragments; must(reader.read(fragments, c_block)) != 0; fragments.clear())
    on_drawn(fragments);
}

}  // namespace

Cuts::Cuts(const HardwareKey& key)
    : golden_(key.shader == Shader::processors ? nullptr : make_golden_model(key)) {}

void Cuts::add(std::span<const std::uint32_t> init_words) {
  if (!golden_) return;
  const std::size_t words_per_vector = (golden_->init_bits() + 31) / 32;
  while (!init_words.empty()) {
    if (end_.clocks >= places_.back().clocks + c_between_places) places_.push_back(end_);
    const std::size_t group = golden_->group(init_words);
    end_.vectors += group;
    end_.clocks += golden_->pixels(init_words) + group;
    init_words = init_words.subspan(std::min(init_words.size(), group * words_per_vector));
  }
}

std::vector<std::uint64_t> Cuts::parts() const {
  std::vector<std::uint64_t> firsts{0};
  for (Place part{0, 0};;) {
    const std::uint64_t wanted = std::max(c_least_part, (end_.clocks - part.clocks) / c_share);
    const auto next = std::ranges::lower_bound(places_, part.clocks + wanted, {}, &Place::clocks);
    if (next == places_.end() || end_.clocks - next->clocks < c_least_part / 2) return firsts;
    part = *next;
    firsts.push_back(part.vectors);
  }
}

std::uint64_t run_in_parts(const GhdlRunner& runner, const HardwareKey& key,
                           const std::filesystem::path& init_file,
                           std::span<const std::uint64_t> first_vectors, const GhdlRunOptions& options,
                           unsigned threads, const Engine::OnDrawn& on_drawn) {
  const std::size_t parts = first_vectors.size();
  std::vector<std::filesystem::path> inits, traces;
  for (std::size_t part = 0; part < parts; ++part) {
    inits.push_back(fmt::format("{}-{}", init_file.string(), part));
    traces.push_back(inits.back().string() + ".trace");
  }
  split(init_file, key.name(), first_vectors, inits);

  std::mutex mutex;
  std::vector<std::uintmax_t> bytes(parts, 0);
  std::uint64_t cycles = 0;
  must_for_each(threads, parts, [&](std::size_t part) {
    GhdlRunOptions of_part = options;
    if (options.on_progress)
      of_part.on_progress = [&, part](std::uintmax_t written) {
        const std::scoped_lock lock(mutex);
        bytes[part] = written;
        options.on_progress(std::accumulate(bytes.begin(), bytes.end(), std::uintmax_t{0}));
      };
    const auto run = runner.run(inits[part], traces[part], of_part);
    if (!run && parts > 1)
      throw Failure{
          {run.error().code, fmt::format("{}, in part {} of {}, from init vector {} on", run.error().message,
                                         part + 1, parts, first_vectors[part])}};
    const std::uint64_t of_run = must(run).cycles;
    const std::scoped_lock lock(mutex);
    cycles += of_run;
  });
  for (const std::filesystem::path& trace : traces) pass_on(trace, key.name(), on_drawn);
  return cycles;
}

Result<GhdlEngine> GhdlEngine::open(const HardwareKey& key, const SimulatorFolders& folders, unsigned threads,
                                    const GhdlRunOptions& options) {
  return caught(
      [&] { return GhdlEngine(key, must(GhdlRunner::open(key, folders)), folders.cache, threads, options); });
}

Result<std::shared_ptr<Engine>> GhdlEngine::another() const {
  return shared_engine(Result<GhdlEngine>(GhdlEngine(key_, runner_, cache_, threads_, options_)));
}

void GhdlEngine::begin() {
  if (init_) return;
  folder_.emplace(must(TemporaryFolder::make(cache_)));
  init_.emplace(must(InitFileWriter::open(init_file(), key_.name(), make_golden_model(key_)->init_bits())));
  cuts_ = Cuts(key_);
}

Status GhdlEngine::draw(std::span<const std::uint32_t> init_words, std::uint64_t, const OnDrawn&) {
  return caught([&] {
    begin();
    init_->write(init_words);
    cuts_.add(init_words);
  });
}

Status GhdlEngine::drain(std::uint64_t most, const OnDrawn& on_drawn) {
  return caught([&] {
    begin();
    must(init_->commit());
    init_.reset();
    const std::vector<std::uint64_t> first_vectors = cuts_.parts();
    parts_ = first_vectors.size();
    options_.max_fragments = static_cast<std::uint32_t>(std::min<std::uint64_t>(most, 0x7fffffff));
    cycles_ = cycles_.value_or(0) +
              run_in_parts(runner_, key_, init_file(), first_vectors, options_, threads_, on_drawn);
  });
}

}  // namespace halfway
