// SPDX-License-Identifier: Apache-2.0
#include "vhdl_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

namespace halfway::mutants {
namespace {

enum class Kind { word, keyword, attribute, number, character, string, mark, end };

struct Token {
  Kind kind;
  std::size_t begin, end;
  std::string_view text;
  bool simulated_only;  ///< between translate_off and translate_on
};

const std::set<std::string_view> c_keywords = {
    "abs",     "alias", "all",      "and",      "architecture", "array",   "assert", "attribute", "begin",
    "block",   "body",  "case",     "constant", "downto",       "else",    "elsif",  "end",       "entity",
    "exit",    "for",   "function", "generate", "generic",      "if",      "impure", "in",        "is",
    "library", "loop",  "map",      "mod",      "nand",         "next",    "nor",    "not",       "null",
    "of",      "open",  "or",       "others",   "out",          "package", "port",   "process",   "procedure",
    "pure",    "range", "record",   "rem",      "report",       "return",  "select", "severity",  "signal",
    "sll",     "srl",   "subtype",  "then",     "to",           "type",    "use",    "variable",  "wait",
    "when",    "while", "with",     "xnor",     "xor"};

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

std::vector<Token> tokens_of(std::string_view text) {
  std::vector<Token> tokens;
  bool simulated_only = false;
  const auto add = [&](Kind kind, std::size_t begin, std::size_t end) {
    tokens.push_back({kind, begin, end, text.substr(begin, end - begin), simulated_only});
  };
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (std::isspace(static_cast<unsigned char>(c)) != 0) {
      ++i;
    } else if (text.substr(i, 2) == "--") {
      const std::size_t end = std::min(text.find('\n', i), text.size());
      const std::string_view comment = text.substr(i, end - i);
      if (comment.find("translate_off") != std::string_view::npos) simulated_only = true;
      if (comment.find("translate_on") != std::string_view::npos) simulated_only = false;
      i = end;
    } else if (std::isdigit(static_cast<unsigned char>(c)) != 0) {
      std::size_t end = i;
      while (end < text.size() && (is_word(text[end]) || text[end] == '.')) ++end;
      add(Kind::number, i, end);
      i = end;
    } else if (is_word(c)) {
      std::size_t end = i;
      while (end < text.size() && is_word(text[end])) ++end;
      const bool attribute = !tokens.empty() && tokens.back().text == "'";
      add(attribute                                      ? Kind::attribute
          : c_keywords.contains(text.substr(i, end - i)) ? Kind::keyword
                                                         : Kind::word,
          i, end);
      i = end;
    } else if (c == '"') {
      const std::size_t end = text.find('"', i + 1) + 1;
      add(Kind::string, i, end);
      i = end;
    } else if (c == '\'' && text.size() > i + 2 && text[i + 2] == '\'' &&
               !(!tokens.empty() && (tokens.back().kind == Kind::word || tokens.back().text == ")"))) {
      add(Kind::character, i, i + 3);
      i += 3;
    } else {
      static constexpr std::string_view c_pairs[] = {"<=", ">=", "=>", ":=", "/=", "**", "<>"};
      const auto pair = std::find(std::begin(c_pairs), std::end(c_pairs), text.substr(i, 2));
      const std::size_t length = pair == std::end(c_pairs) ? 1 : 2;
      add(Kind::mark, i, i + length);
      i += length;
    }
  }
  add(Kind::end, text.size(), text.size());
  return tokens;
}

// Declared together or apart, in one file.
struct Named {
  std::string what;  ///< signal, constant, ...; of a record's field its type
  std::string type;
};

class Reader {
 public:
  Reader(std::string name, std::string_view text)
      : name_(std::move(name)), text_(text), tokens_(tokens_of(text)) {}

  Result<Outline> read() {
    while (!is(Kind::end) && error_.empty()) {
      if (is("entity")) {
        entity();
      } else if (is("architecture")) {
        next();
        next();
        expect("of");
        outline_.architecture_of = std::string(next().text);
        expect("is");
        outline_.declarations = at(-1).end;
        declarations();
        expect("begin");
        for (const auto& port : ports_) watch(at(-1).end, port.first, port.second);
        watch_signals();
        concurrent();
        end_of("architecture");
      } else if (is("package")) {
        next();
        const bool body = is("body");
        if (body) next();
        next();
        expect("is");
        declarations();
        end_of("package");
      } else {
        skip_to_semicolon();
      }
    }
    if (!error_.empty()) return bad_input(error_);
    for (const Use& use : uses_) exchange_name(use);
    std::stable_sort(outline_.changes.begin(), outline_.changes.end(),
                     [](const Change& a, const Change& b) { return a.begin < b.begin; });
    return std::move(outline_);
  }

 private:
  struct Use {
    std::size_t token;
    bool field;
  };

  const Token& at(int offset) const {
    return tokens_[std::min(i_ + static_cast<std::size_t>(offset), tokens_.size() - 1)];
  }
  bool is(std::string_view text) const {
    return at(0).text == text && at(0).kind != Kind::string && error_.empty();
  }
  bool is(Kind kind) const { return at(0).kind == kind; }
  const Token& next() {
    const Token& token = at(0);
    if (i_ + 1 < tokens_.size()) ++i_;
    return token;
  }
  void fail(std::string_view what) {
    if (error_.empty())
      error_ = fmt::format("{}:{}: {} at `{}`: more VHDL than vhdl_text.cpp knows", name_,
                           line_of(text_, at(0).begin), what, at(0).text);
    i_ = tokens_.size() - 1;
  }
  void expect(std::string_view text) {
    if (is(text)) {
      next();
    } else {
      fail(fmt::format("no `{}`", text));
    }
  }
  void skip_to_semicolon() {
    while (!is(";") && !is(Kind::end)) next();
    next();
  }
  void end_of(std::string_view what) {
    if (!is("end")) fail(fmt::format("no end of {}", what));
    skip_to_semicolon();
  }
  // Behind the bracket that belongs to the one here.
  void skip_brackets() {
    int depth = 0;
    do {
      if (is("(")) ++depth;
      if (is(")")) --depth;
      next();
    } while (depth > 0 && !is(Kind::end));
  }
  std::string text_between(std::size_t from, std::size_t to) const {
    std::string all;
    for (std::size_t i = from; i < to; ++i) all.append(tokens_[i].text).push_back(' ');
    return all;
  }

  // `a, b : [in] type` up to one of `stops` outside brackets.
  std::vector<std::string> names_and_type(const std::string& what, std::string& type,
                                          const std::set<std::string_view>& stops) {
    std::vector<std::string> names;
    while (!is(":") && !is(Kind::end)) {
      if (is(Kind::word)) names.emplace_back(at(0).text);
      next();
    }
    expect(":");
    if (is("in") || is("out")) next();
    const std::size_t begin = i_;
    for (int depth = 0; !is(Kind::end) && (depth > 0 || !stops.contains(at(0).text)); next()) {
      if (is("(")) ++depth;
      if (is(")")) --depth;
    }
    type = text_between(begin, i_);
    for (const std::string& name : names) named_.emplace(name, Named{what, type});
    return names;
  }

  void interface(const std::string& what, bool ports) {
    expect("(");
    while (!is(")") && !is(Kind::end)) {
      while (is("signal") || is("constant") || is("variable")) next();
      const bool in = text_.substr(at(0).begin, text_.find(';', at(0).begin) - at(0).begin).find(" out ") ==
                      std::string_view::npos;
      std::string type;
      for (const std::string& name :
           names_and_type(ports ? (in ? "in" : "out") : what, type, {";", ")", ":="}))
        if (ports) ports_.emplace_back(name, type);
      if (is(":="))
        for (int depth = 0; !is(Kind::end) && (depth > 0 || (!is(";") && !is(")"))); next()) {
          if (is("(")) ++depth;
          if (is(")")) --depth;
        }
      if (is(";")) next();
    }
    expect(")");
  }

  void entity() {
    next();
    next();
    expect("is");
    while (!is("end") && !is(Kind::end)) {
      const bool ports = is("port");
      if (ports || is("generic")) {
        next();
        interface("generic", ports);
      }
      skip_to_semicolon();
    }
    skip_to_semicolon();
  }

  void record(const std::string& type_name) {
    next();
    auto& fields = records_[type_name];
    fields.clear();
    while (!is("end") && !is(Kind::end)) {
      std::string type;
      const std::size_t begin = i_;
      while (!is(":") && !is(Kind::end)) next();
      i_ = begin;
      std::vector<std::string> names;
      while (!is(":") && !is(Kind::end)) {
        if (is(Kind::word)) names.emplace_back(at(0).text);
        next();
      }
      expect(":");
      const std::size_t from = i_;
      while (!is(";") && !is(Kind::end)) next();
      type = text_between(from, i_);
      for (const std::string& name : names) fields.emplace_back(name, type);
      expect(";");
    }
    all_records_.push_back(fields);
    skip_to_semicolon();
  }

  bool at_declaration() const {
    static const std::set<std::string_view> c_begins = {"signal",  "constant", "variable", "type",
                                                        "subtype", "alias",    "function", "procedure",
                                                        "pure",    "impure",   "use",      "attribute"};
    return c_begins.contains(at(0).text);
  }

  void declarations() {
    while (at_declaration() && error_.empty()) {
      if (is("signal") || is("constant") || is("variable")) {
        const std::string what(next().text);
        std::string type;
        const auto names = names_and_type(what, type, {";", ":="});
        if (what == "signal")
          for (const std::string& name : names) signals_.emplace_back(name, type);
        if (is(":=")) {
          next();
          const bool table = what == "constant" && type.find("_table_t") != std::string::npos;
          in_table_ = table;
          expression({";"});
          in_table_ = false;
        }
        expect(";");
      } else if (is("type")) {
        next();
        const std::string type(next().text);
        next();
        if (is("record")) {
          record(type);
        } else {
          skip_to_semicolon();
        }
      } else if (is("subtype")) {
        next();
        const std::string name(next().text);
        expect("is");
        subtypes_[name] = std::string(at(0).text);
        skip_to_semicolon();
      } else if (is("alias")) {
        next();
        std::string type;
        names_and_type("constant", type, {"is"});
        skip_to_semicolon();
      } else if (is("function") || is("procedure") || is("pure") || is("impure")) {
        while (is("pure") || is("impure")) next();
        const bool function = next().text == "function";
        next();
        if (is("(")) interface("constant", false);
        if (function) {
          expect("return");
          while (!is(";") && !is("is") && !is(Kind::end)) next();
        }
        if (is("is")) {
          next();
          const auto outer = signals_;
          declarations();
          signals_ = outer;
          expect("begin");
          sequence();
          end_of("subprogram");
        } else {
          expect(";");
        }
      } else {
        skip_to_semicolon();
      }
    }
  }

  void watch(std::size_t place, const std::string& name, const std::string& type) {
    const std::string_view base = std::string_view(type).substr(0, type.find(' '));
    if (const auto fields = records_.find(std::string(base)); fields != records_.end()) {
      for (const auto& [field, field_type] : fields->second) watch(place, name + "." + field, field_type);
      return;
    }
    static const std::set<std::string_view> c_bits = {"std_logic", "std_logic_vector", "unsigned", "signed"};
    const auto subtype = subtypes_.find(std::string(base));
    if (c_bits.contains(subtype == subtypes_.end() ? base : subtype->second))
      outline_.watched.push_back({place, name});
    else
      outline_.unwatched.push_back(name);
  }
  void watch_signals() {
    for (const auto& [name, type] : signals_) watch(at(-1).end, name, type);
    signals_.clear();
  }

  // ---- statements

  void statement(std::size_t begin) {
    if (!at(0).simulated_only) outline_.statements.push_back({begin, true});
  }

  void sequence() {
    while (!is("end") && !is("elsif") && !is("else") && !is("when") && !is(Kind::end) && error_.empty()) {
      const std::size_t begin = at(0).begin;
      if (at(1).text == ":") {
        next();
        next();
      }
      if (is("if")) {
        statement(begin);
        next();
        condition({"then"});
        expect("then");
        sequence();
        while (is("elsif")) {
          next();
          condition({"then"});
          expect("then");
          sequence();
        }
        if (is("else")) {
          next();
          sequence();
        }
        end_of("if");
      } else if (is("case")) {
        statement(begin);
        next();
        expression({"is"});
        expect("is");
        while (is("when")) {
          while (!is("=>") && !is(Kind::end)) next();
          next();
          sequence();
        }
        end_of("case");
      } else if (is("for")) {
        statement(begin);
        next();
        next();
        expect("in");
        expression({"loop"});
        expect("loop");
        sequence();
        end_of("loop");
      } else if (is("while")) {
        statement(begin);
        next();
        condition({"loop"});
        expect("loop");
        sequence();
        end_of("loop");
      } else if (is("return")) {
        statement(begin);
        next();
        expression({";"});
        expect(";");
      } else if (is("null")) {
        statement(begin);
        skip_to_semicolon();
      } else if (is("assert") || is("report")) {
        skip_to_semicolon();
      } else if (is(Kind::word)) {
        statement(begin);
        assignment(true);
      } else {
        fail("statement");
      }
    }
  }

  void generate_body() {
    const auto outer = std::move(signals_);
    signals_.clear();
    declarations();
    if (is("begin")) next();
    watch_signals();
    concurrent();
    signals_ = outer;
    if (is("end") && at(1).text != "generate") skip_to_semicolon();
  }

  void concurrent() {
    while (!is("end") && !is("elsif") && !is("else") && !is(Kind::end) && error_.empty()) {
      const std::size_t begin = at(0).begin;
      const bool simulated_only = at(0).simulated_only;
      if (at(1).text == ":") {
        next();
        next();
      }
      const auto count = [&] {
        if (!simulated_only) outline_.statements.push_back({begin, false});
      };
      if (is("process")) {
        count();
        next();
        if (is("(")) skip_brackets();
        if (is("is")) next();
        const auto outer = signals_;
        declarations();
        signals_ = outer;
        expect("begin");
        sequence();
        end_of("process");
      } else if (is("if")) {
        next();
        expression({"generate"});
        expect("generate");
        generate_body();
        while (is("elsif")) {
          next();
          expression({"generate"});
          expect("generate");
          generate_body();
        }
        if (is("else")) {
          next();
          expect("generate");
          generate_body();
        }
        end_of("generate");
      } else if (is("for")) {
        next();
        next();
        expect("in");
        expression({"generate"});
        expect("generate");
        generate_body();
        end_of("generate");
      } else if (is("block")) {
        next();
        if (is("is")) next();
        const auto outer = std::move(signals_);
        signals_.clear();
        declarations();
        expect("begin");
        watch_signals();
        concurrent();
        signals_ = outer;
        end_of("block");
      } else if (is("entity")) {
        count();
        next();
        while (!is("generic") && !is("port") && !is(";") && !is(Kind::end)) next();
        while (is("generic") || is("port")) {
          const bool ports = is("port");
          next();
          expect("map");
          associations(ports);
        }
        expect(";");
      } else if (is("assert")) {
        skip_to_semicolon();
      } else if (is(Kind::word)) {
        count();
        assignment(false);
      } else {
        fail("concurrent statement");
      }
    }
  }

  void associations(bool ports) {
    expect("(");
    while (!is(")") && !is(Kind::end) && error_.empty()) {
      const std::string formal(at(0).text);
      while (!is("=>") && !is(Kind::end)) next();
      next();
      const std::size_t begin = at(0).begin;
      const bool open = is("open"), simulated_only = at(0).simulated_only;
      if (open) {
        next();
      } else {
        expression({",", ")"});
      }
      const std::size_t end = at(-1).end;
      if (ports && !open && !simulated_only && formal != "clk") {
        static const std::set<std::string_view> c_enables = {"load", "step", "enable", "clear", "reset"};
        if (c_enables.contains(formal))
          change(Operator::enable, begin, end, "'1'");
        else
          change(Operator::enable, begin, end, fmt::format("not ({})", text_.substr(begin, end - begin)));
      }
      if (is(",")) next();
    }
    expect(")");
  }

  void assignment(bool sequential) {
    const std::size_t begin = at(0).begin;
    const bool simulated_only = at(0).simulated_only;
    for (int depth = 0; !is(Kind::end) && !is(";") && (depth > 0 || (!is("<=") && !is(":="))); next()) {
      if (is("(")) ++depth;
      if (is(")")) --depth;
    }
    if (is(";")) return fail("a call");
    next();
    expression({";"});
    expect(";");
    if (sequential && !simulated_only) change(Operator::drop, begin, at(-1).end, "null;");
  }

  void change(Operator by, std::size_t begin, std::size_t end, std::string to) {
    outline_.changes.push_back({by, begin, end, std::move(to)});
  }

  void condition(const std::set<std::string_view>& stops) {
    const std::size_t begin = at(0).begin;
    const bool edge = is("rising_edge"), simulated_only = at(0).simulated_only;
    if (edge) {
      while (!stops.contains(at(0).text) && !is(Kind::end)) next();
    } else {
      expression(stops);
    }
    const std::size_t end = at(-1).end;
    if (simulated_only) return;
    // A clock's edge is no decision.
    if (edge) return;
    outline_.conditions.push_back({begin, end});
    for (const char* held : {"true", "false"}) change(Operator::condition, begin, end, held);
  }

  // Up to one of `stops` outside brackets.
  void expression(const std::set<std::string_view>& stops) {
    std::size_t when = 0;
    for (int depth = 0; !is(Kind::end) && error_.empty(); next()) {
      if (depth == 0 && stops.contains(at(0).text) && !is(Kind::string)) return;
      if (is("(")) ++depth;
      if (is(")")) --depth;
      if (depth == 0 && is("when")) when = at(1).begin;
      if (depth == 0 && is("else") && when != 0 && !at(0).simulated_only) {
        outline_.conditions.push_back({when, at(-1).end});
        for (const char* held : {"true", "false"}) change(Operator::condition, when, at(-1).end, held);
        when = 0;
      }
      if (!at(0).simulated_only) token();
    }
  }

  void token() {
    const Token& t = at(0);
    const auto exchange = [&](Operator by, std::string to) { change(by, t.begin, t.end, std::move(to)); };
    static const std::map<std::string_view, std::pair<Operator, const char*>> c_others = {
        {"and", {Operator::logic, "or"}},   {"or", {Operator::logic, "and"}},
        {"xor", {Operator::logic, "xnor"}}, {"not", {Operator::logic, ""}},
        {"=", {Operator::relation, "/="}},  {"/=", {Operator::relation, "="}},
        {"<", {Operator::relation, "<="}},  {"<=", {Operator::relation, "<"}},
        {">", {Operator::relation, ">="}},  {">=", {Operator::relation, ">"}},
        {"+", {Operator::sum, "-"}},        {"-", {Operator::sum, "+"}},
        {"true", {Operator::bit, "false"}}, {"false", {Operator::bit, "true"}}};
    switch (t.kind) {
      case Kind::number: {
        if (t.text.find_first_not_of("0123456789") != std::string_view::npos) return;
        const long value = std::stol(std::string(t.text));
        if (in_table_) {
          // Of the bits that the entry has, one for each entry.
          const int bits = 8;
          return exchange(Operator::rom, std::to_string(value ^ (1L << (rom_entries_++ % bits))));
        }
        exchange(Operator::number, std::to_string(value + 1));
        if (value > 0) exchange(Operator::number, std::to_string(value - 1));
        return;
      }
      case Kind::character:
        if (t.text == "'0'" || t.text == "'1'") exchange(Operator::bit, t.text == "'0'" ? "'1'" : "'0'");
        return;
      case Kind::string:
        if (t.text.find_first_not_of("01\"") == std::string_view::npos && t.text.size() > 2) {
          std::string to(t.text);
          char& digit = to[1 + t.begin % (to.size() - 2)];
          digit = digit == '0' ? '1' : '0';
          exchange(Operator::bit, to);
        }
        return;
      case Kind::word:
        if (t.text == "true" || t.text == "false") break;
        uses_.push_back({i_, at(-1).text == "."});
        return;
      case Kind::keyword:
      case Kind::mark:
        break;
      default:
        return;
    }
    if (const auto other = c_others.find(t.text); other != c_others.end())
      exchange(other->second.first, other->second.second);
  }

  // For one use of a name one other, which the place in the text picks.
  void exchange_name(const Use& use) {
    const Token& t = tokens_[use.token];
    std::vector<std::string> others;
    if (use.field) {
      for (const auto& fields : all_records_) {
        const auto own = std::find_if(fields.begin(), fields.end(),
                                      [&](const auto& field) { return field.first == t.text; });
        if (own == fields.end()) continue;
        for (const auto& [field, type] : fields)
          if (type == own->second && field != t.text) others.push_back(field);
      }
    } else if (tokens_[use.token + 1].text != "=>") {
      const auto own = named_.find(std::string(t.text));
      if (own == named_.end()) return;
      for (const auto& [name, named] : named_)
        if (name != t.text && name != "clk" && named.type == own->second.type &&
            (named.what == own->second.what || (named.what == "in" && own->second.what == "signal")))
          others.push_back(name);
    }
    if (others.empty()) return;
    outline_.changes.push_back({Operator::name, t.begin, t.end, others[(t.begin * 31) % others.size()]});
  }

  std::string name_;
  std::string_view text_;
  std::vector<Token> tokens_;
  std::size_t i_ = 0;
  std::string error_;
  Outline outline_;
  std::multimap<std::string, Named> named_;
  std::map<std::string, std::vector<std::pair<std::string, std::string>>> records_;
  std::vector<std::vector<std::pair<std::string, std::string>>> all_records_;
  std::map<std::string, std::string> subtypes_;
  std::vector<std::pair<std::string, std::string>> ports_, signals_;
  std::vector<Use> uses_;
  bool in_table_ = false;
  int rom_entries_ = 0;
};

}  // namespace

const char* to_string(Operator which) {
  static constexpr const char* c_names[c_operators] = {"logic", "relation",  "sum",    "bit",  "number",
                                                       "table", "condition", "enable", "name", "drop"};
  return c_names[static_cast<int>(which)];
}

Result<Outline> outline_of(const std::string& name, std::string_view text) {
  return Reader(name, text).read();
}

std::size_t line_of(std::string_view text, std::size_t at) {
  return 1 + static_cast<std::size_t>(
                 std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

}  // namespace halfway::mutants
