// SPDX-License-Identifier: Apache-2.0
// Traces. A file is read completely or refused. A trace that was read, written and read again is the same,
// compares equal with itself, and assembles to a frame of its size.
#include "sim/files/trace.hpp"

#include "frame/assemble.hpp"
#include "inputs/random/fuzz.hpp"
#include "sim/driver/stream_comparator.hpp"

namespace halfway::fuzz {
namespace {

void assemble(const Trace& trace, FrameSize size) {
  FrameAssembler assembler(size, {0.5, 0.0, 1.0});
  const Status added = assembler.add(trace.fragments);
  if (!added) demand(added.error().code == ExitCode::differs, added.error().message);
  demand(assembler.frame().rgb.size() == 3 * std::size_t{size.width} * size.height,
         "a frame of another size");
  demand(assembler.covered_pixels() <= assembler.mask().size(), "more covered pixels than there are");
}

}  // namespace
}  // namespace halfway::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace halfway;
  using namespace halfway::fuzz;
  const auto path = write_input("input.trace", text_of(data, size));
  const auto trace = read_trace(path, {});
  if (!trace) {
    demand_refusal(trace.error());
    demand(trace.error().message.starts_with(path.string() + ":"), "file:line: " + trace.error().message);
    return 0;
  }
  auto reader = TraceReader::open(path, {});
  demand(bool(reader), "a trace that opens once opens again");
  const std::string key = reader->key_name();
  demand(!read_trace(path, key + "x"), "a trace of other hardware");

  const auto copy = folder() / "copy.trace";
  demand(bool(write_trace(copy, key, *trace)), "writing back");
  const auto again = read_trace(copy, key);
  demand(bool(again) && again->fragments == trace->fragments && again->cycles == trace->cycles,
         "what was written back reads the same");

  auto other = TraceReader::open(copy, key);
  demand(bool(other), "the copy opens");
  StreamComparator comparator;
  demand(
      bool(read_side_by_side(*reader, *other, [&](auto golden, auto rtl) { comparator.add(golden, rtl); })),
      "both read to their ends");
  comparator.finish();
  demand(comparator.mismatches() == 0, "equal to itself");

  assemble(*trace, {4096, 16});
  assemble(*trace, {24, 18});
  return 0;
}
