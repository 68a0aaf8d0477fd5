// SPDX-License-Identifier: Apache-2.0
#include "mutants/replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <sstream>
#include <string_view>

#include "sim/os/file.hpp"
#include "sim/os/must.hpp"

namespace halfway::mutants {
namespace {

constexpr unsigned c_idle_limit = 10'000;  ///< clocks without a transfer that count as a hang
constexpr unsigned c_idle_clocks = 10;     ///< checked after each pass
constexpr unsigned c_reset_clocks = 3;
constexpr unsigned c_most_ports = 64;

using Difference = std::optional<std::string>;

std::size_t bytes_of(std::uint32_t bits) {
  return (bits + 7) / 8;
}

std::string to_hex(const void* data, std::uint32_t bits) {
  std::string text;
  for (std::size_t i = bytes_of(bits); i-- > 0;)
    text += fmt::format("{:02X}", static_cast<const std::uint8_t*>(data)[i]);
  return text;
}

/// "!name/3?!gate": an inverted column of three words, compared where the gate is '0'.
struct ColumnText {
  std::string name, gate;
  bool inverted = false, gate_inverted = false;
  unsigned words = 1;
};

ColumnText parse_column(std::string text) {
  ColumnText column;
  if (const auto at = text.find('?'); at != std::string::npos) {
    column.gate = text.substr(at + 1);
    text.resize(at);
    column.gate_inverted = column.gate.starts_with('!');
    if (column.gate_inverted) column.gate.erase(0, 1);
  }
  if (const auto at = text.find('/'); at != std::string::npos) {
    column.words = static_cast<unsigned>(std::stoul(text.substr(at + 1)));
    text.resize(at);
  }
  column.inverted = text.starts_with('!');
  column.name = text.substr(column.inverted ? 1 : 0);
  return column;
}

std::vector<ColumnText> parse_columns(const std::string& text) {
  std::vector<ColumnText> columns;
  std::istringstream stream(text);
  for (std::string word; stream >> word;) columns.push_back(parse_column(word));
  return columns;
}

Word parse_word(std::string_view digits) {
  Word word((digits.size() + 1) / 2);
  for (std::size_t i = 0; i < digits.size(); ++i) {
    const char digit = digits[digits.size() - 1 - i];
    const int value = digit <= '9' ? digit - '0' : digit - 'A' + 10;
    word[i / 2] = static_cast<std::uint8_t>(word[i / 2] | value << (i % 2 * 4));
  }
  return word;
}

/// Removes the padding between the words of a column; each word starts at a byte.
Word packed(const Word& padded, unsigned words, std::uint32_t bits) {
  const std::size_t each = bits / words;
  const std::size_t stride = padded.size() / words * 8;
  Word word(bytes_of(bits));
  for (std::size_t bit = 0; bit < bits; ++bit) {
    const std::size_t from = bit / each * stride + bit % each;
    if ((padded[from / 8] >> from % 8 & 1) != 0)
      word[bit / 8] = static_cast<std::uint8_t>(word[bit / 8] | 1U << bit % 8);
  }
  return word;
}

/// xorshift32 (Marsaglia 2003), as in tb/rtl/tb_pkg.vhd.
class Random {
 public:
  explicit Random(std::uint32_t seed) : state_(seed) {}
  /// True with probability 1 / one_in.
  bool chance(unsigned one_in) {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 17;
    state_ ^= state_ << 5;
    return (state_ >> 8) % one_in == 0;
  }

 private:
  std::uint32_t state_;
};

class Model {
 public:
  Model(const CompiledNetlist& netlist, std::uint32_t fault) : netlist_(netlist), model_(netlist.create()) {
    count_ = netlist.ports(model_, ports_.data());
    clk_ = find("clk");
    reset_ = find("reset");
    set(find("mutsel"), fault);
    netlist_.eval(model_);
  }
  ~Model() { netlist_.destroy(model_); }
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;

  const ModelPort* find(std::string_view name) const {
    for (std::uint32_t i = 0; i < count_; ++i)
      if (ports_[i].name == name) return &ports_[i];
    return nullptr;
  }
  const ModelPort* reset() const { return reset_; }

  static bool is_set(const ModelPort* port) {
    return port != nullptr && *static_cast<const std::uint8_t*>(port->data) != 0;
  }
  static void set(const ModelPort* port, std::uint32_t value) {
    if (port != nullptr) std::memcpy(port->data, &value, std::min<std::size_t>(bytes_of(port->bits), 4));
  }
  static void write(const ModelPort* port, const Word& word) {
    std::memcpy(port->data, word.data(), std::min(word.size(), bytes_of(port->bits)));
  }
  static void fill_with_ones(const ModelPort* port) {
    std::memset(port->data, 0xFF, bytes_of(port->bits));
    if (port->bits % 8 != 0)
      static_cast<std::uint8_t*>(port->data)[port->bits / 8] =
          static_cast<std::uint8_t>((1U << port->bits % 8) - 1);
  }

  /// Updates everything that depends on changed inputs without a register.
  void settle() { netlist_.eval(model_); }
  void rising_edge() {
    if (clk_ == nullptr) return;
    set(clk_, 1);
    netlist_.eval(model_);
    set(clk_, 0);
    netlist_.eval(model_);
  }

 private:
  const CompiledNetlist& netlist_;
  void* model_;
  std::array<ModelPort, c_most_ports> ports_{};
  std::uint32_t count_ = 0;
  const ModelPort* clk_ = nullptr;
  const ModelPort* reset_ = nullptr;
};

/// The columns of a file, bound to the model's ports.
class Columns {
 public:
  Columns(const Model& model, const std::string& text) : columns_(parse_columns(text)) {
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const ColumnText& column = columns_[i];
      Bound bound{.port = model.find(column.name), .gate_port = model.find(column.gate)};
      for (std::size_t j = 0; j < columns_.size(); ++j) {
        if (!column.gate.empty() && columns_[j].name == column.gate && bound.gate_port == nullptr)
          bound.gate_column = static_cast<int>(j);
        if (columns_[j].name == "checked") checked_ = static_cast<int>(j);
      }
      bound_.push_back(bound);
    }
  }

  /// The word of the column `name`; null if there is no such column.
  const Word* find(const std::string& name, const std::vector<Word>& row) const {
    for (std::size_t i = 0; i < columns_.size(); ++i)
      if (columns_[i].name == name) return &row[i];
    return nullptr;
  }
  bool is_checked(const std::vector<Word>& row) const {
    return checked_ < 0 || row[static_cast<std::size_t>(checked_)][0] != 0;
  }
  void drive(const std::vector<Word>& row) const {
    for (std::size_t i = 0; i < bound_.size(); ++i)
      if (bound_[i].port != nullptr && bound_[i].port->is_input != 0) Model::write(bound_[i].port, row[i]);
  }
  void drive_ones(std::string_view steady) const {
    for (std::size_t i = 0; i < bound_.size(); ++i)
      if (bound_[i].port != nullptr && bound_[i].port->is_input != 0 && columns_[i].name != steady)
        Model::fill_with_ones(bound_[i].port);
  }
  /// Compares the outputs, except the port `left_out`.
  Difference compare(const std::vector<Word>& row, std::string_view left_out = {}) const {
    if (!is_checked(row)) return {};
    for (std::size_t i = 0; i < bound_.size(); ++i) {
      const Bound& bound = bound_[i];
      if (bound.port == nullptr || bound.port->is_input != 0 || columns_[i].name == left_out) continue;
      if (!columns_[i].gate.empty()) {
        const bool gate = bound.gate_port != nullptr
                              ? Model::is_set(bound.gate_port)
                              : row[static_cast<std::size_t>(bound.gate_column)][0] != 0;
        if (gate == columns_[i].gate_inverted) continue;
      }
      Word expected = columns_[i].words == 1 ? row[i] : packed(row[i], columns_[i].words, bound.port->bits);
      if (columns_[i].inverted) expected[0] ^= 1;
      if (std::memcmp(expected.data(), bound.port->data, bytes_of(bound.port->bits)) != 0)
        return fmt::format("{} is {}, expected {}", columns_[i].name,
                           to_hex(bound.port->data, bound.port->bits),
                           to_hex(expected.data(), bound.port->bits));
    }
    return {};
  }

 private:
  struct Bound {
    const ModelPort* port = nullptr;
    const ModelPort* gate_port = nullptr;
    int gate_column = 0;
  };
  std::vector<ColumnText> columns_;
  std::vector<Bound> bound_;
  int checked_ = -1;
};

void reset(Model& model) {
  Model::set(model.reset(), 1);
  for (unsigned i = 0; i < c_reset_clocks; ++i) {
    model.settle();
    model.rising_edge();
  }
  Model::set(model.reset(), 0);
}

/// One row per clock: the inputs of the clock and the outputs before its edge.
Difference replay_rows(const Design& design, const VectorFile& file, Model& model) {
  const Columns columns(model, design.rows);
  reset(model);
  const ModelPort* ready = model.find("ready");
  for (std::size_t i = 0; i < file.rows.size(); ++i) {
    const auto& row = file.rows[i];
    const auto differs = [&](const std::string& what) {
      return fmt::format("{}: vector {}: {}", file.name, i, what);
    };
    columns.drive(row);
    model.settle();
    // Wait while the entity is not ready.
    if (const Word* waits = columns.find("waits", row)) {
      std::uint32_t clocks = 0;
      std::memcpy(&clocks, waits->data(), std::min<std::size_t>(waits->size(), 4));
      for (; clocks > 0; --clocks) {
        if (Model::is_set(ready)) return differs("is ready too early");
        model.rising_edge();
      }
      if (!Model::is_set(ready) && !Model::is_set(model.reset())) return differs("is not ready");
    }
    if (auto difference = columns.compare(row)) return differs(*difference);
    model.rising_edge();
  }
  return {};
}

struct Pace {
  unsigned offer = 1;  ///< a vector is offered in one of this number of clocks
  unsigned take = 1;   ///< an output is accepted in one of this number of clocks
  std::uint32_t seed = 1;
  unsigned reset_at = 0;  ///< clock of a reset that ends the pass; 0: no reset
  bool full() const { return offer == 1 && take == 1 && reset_at == 0; }
};

/// A stream during a pass.
struct Lane {
  const Stream& stream;
  const VectorFile& file;
  Columns columns;
  const ModelPort *valid, *ready, *with;
  std::size_t next = 0;  ///< the row that is offered, or expected next
  bool waiting = false;

  Lane(const Model& model, const Stream& its_stream, const VectorFile& its_file)
      : stream(its_stream),
        file(its_file),
        columns(model, its_stream.columns),
        valid(model.find(its_stream.port + "_valid")),
        ready(model.find(its_stream.port + "_ready")),
        with(model.find(its_stream.with)) {
    if (valid == nullptr) valid = model.find(its_stream.port);
  }
  bool at_end() const { return next == file.rows.size(); }
  const std::vector<Word>& row() const { return file.rows[next]; }
  void skip_unchecked() {
    while (!at_end() && !columns.is_checked(row())) ++next;
  }
  bool is_set(const std::string& column) const {
    const Word* word = columns.find(column, row());
    return word != nullptr && (*word)[0] != 0;
  }
  std::string differs(const std::string& what) const {
    return fmt::format("{}: vector {}: {}", file.name, next, what);
  }
};

/// One pass of a set through valid/ready streams.
class StreamPass {
 public:
  StreamPass(const Design& design, const DesignVectors::Set& set, Model& model, const Pace& pace)
      : model_(model),
        pace_(pace),
        random_(pace.seed),
        busy_(model.find("busy")),
        idle_(model.find("idle")),
        fault_(model.find("fault")),
        clear_(model.find("clear")),
        stalled_(model.find(design.stalled)),
        input_(model, design.input, set.files[0]),
        covered_(busy_ != nullptr && design.busy),
        faulty_(set.name.ends_with("fault")) {
    for (std::size_t i = 1; i < set.files.size(); ++i) {
      outputs_.emplace_back(model, design.outputs[i - 1], set.files[i]);
      // The last row gives the expected fault at the end.
      if (const Word* last = outputs_.back().columns.find("fault", set.files[i].rows.back())) {
        faulty_ = (*last)[0] != 0;
        fault_at_end_ = true;
      }
    }
  }

  Difference run() {
    for (Lane& lane : outputs_) lane.skip_unchecked();
    for (unsigned tick = 1;; ++tick) {
      drive(tick == pace_.reset_at);
      model_.settle();
      if (tick != pace_.reset_at)
        if (auto difference = check()) return difference;
      const bool ended = tick == pace_.reset_at || done();
      model_.rising_edge();
      after_edge();
      if (ended) break;
      if (++still_ > c_idle_limit) return fmt::format("{}: hangs", input_.file.name);
    }
    if (pace_.reset_at == 0)
      for (const Lane& lane : outputs_)
        if (!lane.at_end()) return lane.differs("does not come");
    return check_idle();
  }

 private:
  void drive(bool resets) {
    Model::set(model_.reset(), resets);
    Model::set(stalled_, random_.chance(pace_.take));
    // A clear is given between tokens, with no token offered.
    const bool clears = clear_ != nullptr && !input_.at_end() && input_.is_set("clear");
    clears_now_ = clears && was_idle_;
    clearing_ = clearing_ || clears_now_;
    input_.waiting = !input_.at_end() && !clears && (input_.waiting || random_.chance(pace_.offer));
    if (input_.waiting)
      input_.columns.drive(input_.row());
    else
      input_.columns.drive_ones(input_.stream.steady);
    Model::set(input_.valid, input_.waiting);
    Model::set(clear_, clears_now_);
    for (const Lane& lane : outputs_)
      if (lane.ready != nullptr) Model::set(lane.ready, random_.chance(pace_.take));
  }

  Difference check() {
    const bool ready = Model::is_set(input_.ready);
    if (taken_ && covered_ && !Model::is_set(busy_))
      return input_.differs("follows one that is taken, but busy is '0'");
    if (Model::is_set(idle_) && !ready) return input_.differs("is not ready, but idle is '1'");
    taken_ = input_.waiting && ready;
    if (clock_ >= 0 || taken_) ++clock_;
    if (!faulty_ && !fault_at_end_ && Model::is_set(fault_)) return fmt::format("clock {}: fault", clock_);
    for (Lane& lane : outputs_) {
      const bool valid = Model::is_set(lane.valid);
      if (lane.waiting && !valid) return lane.differs("is withdrawn");
      if (valid && lane.with != nullptr && !Model::is_set(lane.with))
        return lane.differs("comes without " + lane.stream.with);
      if (valid) {
        if (covered_ && !Model::is_set(busy_)) return lane.differs("comes, but busy is '0'");
        if (lane.at_end()) return lane.differs("comes after all that are expected");
        if (auto difference = lane.columns.compare(lane.row(), "fault")) return lane.differs(*difference);
        if (pace_.full() && !lane.waiting)
          if (auto difference = check_clock(lane)) return difference;
        still_ = 0;
      }
    }
    if (ready && !clears_now_) clearing_ = false;
    if (input_.stream.prompt && pace_.full() && input_.waiting && !ready && !clearing_)
      return input_.differs("is not taken at once");
    if (taken_ && pace_.full())
      if (auto difference = check_clock(input_)) return difference;
    advance();
    return {};
  }

  Difference check_clock(const Lane& lane) const {
    const Word* word = lane.columns.find("clock", lane.row());
    if (word == nullptr) return {};
    std::uint32_t expected = 0;
    std::memcpy(&expected, word->data(), 4);
    if (static_cast<std::int64_t>(expected) == clock_) return {};
    return lane.differs(fmt::format("comes in clock {}, expected {}", clock_, expected));
  }

  void advance() {
    was_idle_ = Model::is_set(idle_);
    for (Lane& lane : outputs_) {
      const bool valid = Model::is_set(lane.valid);
      lane.waiting = valid && lane.ready != nullptr && !Model::is_set(lane.ready);
      if (valid && !lane.waiting) {
        ++lane.next;
        lane.skip_unchecked();
      }
    }
  }

  /// Advances to the next vector if this clock's edge took one.
  void after_edge() {
    if (!taken_ && !clears_now_) return;
    input_.waiting = false;
    ++input_.next;
    still_ = 0;
  }

  /// All inputs are taken and all outputs are received.
  bool done() const {
    if (!input_.at_end()) return false;
    for (const Lane& lane : outputs_)
      if (Model::is_set(lane.valid)) return false;
    return covered_ ? !Model::is_set(busy_) : still_ > c_idle_clocks;
  }

  Difference check_idle() {
    Model::set(model_.reset(), 0);
    Model::set(stalled_, 1);
    Model::set(input_.valid, 0);
    Model::set(clear_, 0);
    for (const Lane& lane : outputs_)
      if (lane.ready != nullptr) Model::set(lane.ready, 1);
    for (unsigned i = 0; i < c_idle_clocks; ++i) {
      model_.settle();
      for (const Lane& lane : outputs_)
        if (Model::is_set(lane.valid))
          return fmt::format("{}: {} when idle", lane.file.name, lane.stream.port);
      if (Model::is_set(busy_)) return fmt::format("{}: busy when idle", input_.file.name);
      if (!faulty_ && Model::is_set(fault_)) return fmt::format("{}: fault when idle", input_.file.name);
      model_.rising_edge();
    }
    if (!faulty_) return {};
    if (pace_.reset_at == 0 && !Model::is_set(fault_))
      return fmt::format("{}: no fault at the end", input_.file.name);
    reset(model_);
    return {};
  }

  Model& model_;
  Pace pace_;
  Random random_;
  const ModelPort *busy_, *idle_, *fault_, *clear_, *stalled_;
  Lane input_;
  std::vector<Lane> outputs_;
  bool covered_;  ///< busy is '1' whenever a word is inside
  bool faulty_, fault_at_end_ = false, was_idle_ = false, clearing_ = true, clears_now_ = false,
                taken_ = false;
  std::int64_t clock_ = -1;  ///< 0: the first vector is accepted
  unsigned still_ = 0;       ///< clocks without a transfer
};

constexpr std::array c_paces = {
    Pace{},
    Pace{.offer = 2, .take = 2, .seed = 12},
    Pace{.offer = 16, .take = 1, .seed = 13},
    Pace{.offer = 1, .take = 4, .seed = 14},
    Pace{.seed = 20, .reset_at = 6},
    Pace{.offer = 1, .take = 2, .seed = 21, .reset_at = 57},
    Pace{.seed = 22, .reset_at = 311},
    Pace{.seed = 23},
};

}  // namespace

VectorFile read_vectors(const std::filesystem::path& file, const std::string& columns, unsigned skip) {
  std::istringstream lines(must(read_file(file)));
  VectorFile vectors{file.filename().string(), {}};
  const auto parsed = parse_columns(columns);
  std::string line;
  for (unsigned number = 0; std::getline(lines, line) && !line.starts_with("end "); ++number) {
    if (number < skip) continue;
    std::vector<Word> row;
    std::istringstream words(line);
    for (const ColumnText& column : parsed) {
      Word joined;
      for (unsigned i = 0; i < column.words; ++i) {
        std::string digits;
        if (!(words >> digits))
          throw Failure{bad_input(fmt::format("{}:{}: has no word for the column {}; correct designs.toml",
                                              file.string(), number + 1, column.name))};
        const Word word = parse_word(digits);
        joined.insert(joined.end(), word.begin(), word.end());
      }
      row.push_back(std::move(joined));
    }
    vectors.rows.push_back(std::move(row));
  }
  if (vectors.rows.empty())
    throw Failure{bad_input(file.string() + ": holds no vector; halfway_vectors writes it")};
  return vectors;
}

DesignVectors read_design_vectors(const Design& design, const std::filesystem::path& folder) {
  DesignVectors all;
  for (const std::string& name : design.sets) {
    DesignVectors::Set set{name, {}};
    std::vector<Stream> streams{design.input};
    streams.insert(streams.end(), design.outputs.begin(), design.outputs.end());
    if (!design.rows.empty()) streams = {{"", "", design.rows, false}};
    for (const Stream& stream : streams)
      set.files.push_back(read_vectors(folder / (name + stream.file + ".txt"), stream.columns, design.skip));
    all.sets.push_back(std::move(set));
  }
  return all;
}

CompiledNetlist::CompiledNetlist(SharedLibrary library) : library_(std::move(library)) {
  must(library_.bind(create, "mutant_create", destroy, "mutant_destroy", eval, "mutant_eval", ports,
                     "mutant_ports"));
}

std::optional<std::string> replay(const Design& design, const DesignVectors& vectors,
                                  const CompiledNetlist& netlist, std::uint32_t fault) {
  Model model(netlist, fault);
  if (!design.rows.empty()) {
    for (const auto& set : vectors.sets)
      if (auto difference = replay_rows(design, set.files[0], model)) return difference;
    return {};
  }
  reset(model);
  for (const Pace& pace : c_paces)
    for (const auto& set : vectors.sets) {
      if (design.reset) reset(model);
      if (auto difference = StreamPass(design, set, model, pace).run())
        return fmt::format("{} (offered one clock in {}, taken one in {}, reset at clock {})", *difference,
                           pace.offer, pace.take, pace.reset_at);
    }
  return {};
}

}  // namespace halfway::mutants
