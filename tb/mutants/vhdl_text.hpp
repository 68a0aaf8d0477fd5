// SPDX-License-Identifier: Apache-2.0
// VHDL as text with places in it: where statements begin, what conditions are, what can be made faulty. It
// knows as much of the grammar as the RTL uses and says so where it meets more.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "common/result.hpp"

namespace halfway::mutants {

/// What a mutant is made by, in the page's order.
enum class Operator {
  logic,      ///< and, or, xor, not
  relation,   ///< = and /=, < and <=, > and >=
  sum,        ///< + and -
  bit,        ///< '0' and '1', a bit of a literal, true and false
  number,     ///< one more, one less
  rom,        ///< a bit of an entry of a table
  condition,  ///< held true, held false
  enable,     ///< an instance's load, step, enable, clear or reset held at '1'; any other input inverted
  name,       ///< another name of the same type
  drop,       ///< an assignment left out
};
inline constexpr int c_operators = static_cast<int>(Operator::drop) + 1;
const char* to_string(Operator which);

/// The text in [begin, end) exchanged.
struct Change {
  Operator by;
  std::size_t begin, end;
  std::string to;
};

struct Statement {
  std::size_t at;
  bool sequential;  ///< of a process or a subprogram
};

/// Of an if, an elsif, a when that stands before an else, a while, an exit.
struct Condition {
  std::size_t begin, end;
};

/// A signal or port of an architecture, or a scalar or vector field of one that is a record.
struct Watched {
  std::size_t at;    ///< where a concurrent statement that looks at it can stand
  std::string name;  ///< as VHDL selects it
};

struct Outline {
  std::string architecture_of;   ///< the entity; empty: a package
  std::size_t declarations = 0;  ///< where the architecture's begin
  std::vector<Statement> statements;
  std::vector<Condition> conditions;
  std::vector<Watched> watched;
  std::vector<std::string> unwatched;  ///< signals that are neither bits nor records of bits
  std::vector<Change> changes;         ///< every one there is, in the order of the text
};

/// Of one file: one entity and its architecture, or one package and its body. Comments, strings, what stands
/// between synthesis translate_off and translate_on, headers, types and messages are left alone.
Result<Outline> outline_of(const std::string& name, std::string_view text);

std::size_t line_of(std::string_view text, std::size_t at);

}  // namespace halfway::mutants
