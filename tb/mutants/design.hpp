// SPDX-License-Identifier: Apache-2.0
// The content of designs.toml and rows.toml: the netlists that get faults, and which columns of which vector
// files drive and check their ports.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "sim/os/toml_file.hpp"

namespace halfway::mutants {

/// A valid/ready stream, or strobes without `ready`, with the vector files that drive or check it.
struct Stream {
  std::string port;     ///< <port>_valid and <port>_ready, or a strobe
  std::string file;     ///< the file is called <set><this name>
  std::string columns;  ///< names of ports, in the order of the file's words
  bool prompt = false;  ///< at full speed every vector is accepted immediately
  std::string with;     ///< of a strobe: it comes only while this input is 1
  std::string steady;   ///< of an input: the port that keeps its word while no vector is offered
};

struct Design {
  std::string entity;
  std::string name;  ///< <entity>.<variant>
  std::vector<std::pair<std::string, std::string>> generics;
  std::vector<std::string> sets;  ///< of vector files, with the entity's folder
  unsigned faults = 0;
  std::string rows;   ///< columns of files with one line per clock; empty: streams
  unsigned skip = 0;  ///< lines at the start of each file that are no vectors
  Stream input;
  std::vector<Stream> outputs;
  std::string stalled;                      ///< a ready input without a stream
  bool reset = false;                       ///< before each pass, since the vectors start from that state
  bool busy = true;                         ///< '1' whenever a word is inside
  bool proofs = true;                       ///< whether survivors are tried to be proved equivalent
  bool quick = false;                       ///< part of the quick form
  std::vector<std::string> without_faults;  ///< own_cells: the entities that are tested by themselves
};

// These functions throw Failure, with file and line.

inline std::string text_of(const toml::table& table, const char* name) {
  return table[name].value_or(std::string());
}

/// `read` of each table in the list `name`.
template <class Item, class Read>
std::vector<Item> read_list(const toml::table& all, const char* name, const Read& read) {
  std::vector<Item> items;
  for (const toml::node& node : *all[name].as_array()) items.push_back(read(*node.as_table()));
  return items;
}

std::vector<Design> read_designs(const std::filesystem::path& source);

/// An entity without a netlist of its own in designs.toml.
struct Without {
  std::string entity, within, reason;  ///< one of the last two is empty
};
std::vector<Without> read_without(const std::filesystem::path& file);

/// Why no vector finds the faults of a VHDL line.
struct Survivor {
  std::string file, text, reason;  ///< `text` is part of the line
};
std::vector<Survivor> read_survivors(const std::filesystem::path& file);

}  // namespace halfway::mutants
