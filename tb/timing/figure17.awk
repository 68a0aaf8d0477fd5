# SPDX-License-Identifier: Apache-2.0
# Reads the trace of interpolator_timing_tb's first line (VCD, as GHDL writes it), writes what figure17.gnuplot draws
# and the text that stands for the picture: blocks of rows, each under "# " and its name. Times are in ns.
#
#   wires     signal from until level
#   values    signal from until pixel middle text   middle of the time before the next value is on its way
#   work      signal from until pixel               from its input's last move to its own
#   both      from until                            stage 1 at work while stage 2 is
#   pixels    number from until                     each from its step on
#   steps     from until                            between two steps
#   words     text
#   constants name value                            slope, factor, and the end of the trace

BEGIN {
  # What each signal waits for, as the hardware is wired.
  inputs["step"] = inputs["init"] = inputs["ra"] = ""
  inputs["angle"] = "step"
  inputs["sum"] = "angle"
  inputs["next_angle"] = "sum init"
  inputs["sample"] = "ra"
  inputs["product"] = "sample"
  is_constant["slope"] = is_constant["factor"] = 1
  lanes = split("step init sum next_angle angle ra sample product", lane)
}

function row(block, text) { rows[block] = rows[block] text "\n" }

function later(a, b) { return a > b ? a : b }

function sooner(a, b) { return a < b ? a : b }

function to_hexadecimal(bits,   text, nibble, i) {
  if (bits !~ /^[01]+$/) return "X"
  while (length(bits) % 4) bits = "0" bits
  for (; bits != ""; bits = substr(bits, 5)) {
    nibble = 0
    for (i = 1; i <= 4; i++) nibble = 2 * nibble + substr(bits, i, 1)
    text = text substr("0123456789ABCDEF", nibble + 1, 1)
  }
  return text
}

# The signal's value ends now; it began to change when its input did.
function close_value(signal, began) {
  if (is_wire[signal]) row("wires", signal " " since[signal] " " now " " value[signal])
  else if (now > since[signal])
    row("values", signal " " since[signal] " " now " " pixel[signal] " " (since[signal] + began) / 2 " " value[signal])
}

function pixel_of(signal) {
  if (signal == "sum") return pixel["angle"] + 1
  if (signal == "next_angle") return value["init"] == 1 ? 0 : pixel["sum"]
  if (signal == "sample" || signal == "product") return pixel[inputs[signal]]
  return pixels - 1
}

function move(signal, to,   names, count, i, began) {
  if (signal in value && to == value[signal]) return
  began = now
  if (to != "X" && inputs[signal] != "") {
    count = split(inputs[signal], names)
    for (began = i = 0; i++ < count;) began = later(began, since[names[i]])
  }
  if (signal in value) close_value(signal, began)
  value[signal] = to
  since[signal] = now
  pixel[signal] = to == "X" ? -1 : pixel_of(signal)
  if (signal == "step" && to == 1) {
    if (pixels) {
      row("pixels", pixels - 1 " " step_at " " now)
      row("steps", step_at " " now)
    }
    pixels++
    step_at = now
    stage_1 = 0
  }
  if (to == "X") return

  if (signal in is_constant) row("constants", signal " " to)
  told[pixel[signal], signal] = to " at " now " ns"
  if (began < now) row("work", signal " " began " " now " " pixel[signal])
  if (signal == "sum" || signal == "next_angle") {
    stage_1_from[++stage_1] = began
    stage_1_until[stage_1] = now
  } else if (signal == "product")
    for (i = 1; i <= stage_1; i++)
      if (stage_1_from[i] < now && stage_1_until[i] > since["ra"])
        row("both", later(stage_1_from[i], since["ra"]) " " sooner(stage_1_until[i], now))
}

$1 == "$scope" { scope = scope "/" $3 }
$1 == "$upscope" { sub("/[^/]*$", "", scope) }
$1 == "$var" && scope == "/interpolator_timing_tb" {
  sub(/\[.*/, "", $5)
  if ($5 in inputs || $5 in is_constant) name[$4] = $5
  is_wire[$5] = $3 == 1
}
/^#/ { now = substr($1, 2) / 1000000 }
/^b/ && $2 in name { move(name[$2], to_hexadecimal(substr($1, 2))) }
/^[01]/ && substr($1, 2) in name { move(name[substr($1, 2)], substr($1, 1, 1)) }

END {
  row("pixels", pixels - 1 " " step_at " " now)
  row("constants", "end " now)
  for (i = 1; i <= lanes; i++) close_value(lane[i], now)
  for (i = 0; i < pixels; i++)
    row("words", "Pixel " i ": angle " told[i, "angle"] ", ra " told[i, "ra"] ", sample " told[i, "sample"] \
      ", product " told[i, "product"] "; beside it the sum for pixel " i + 1 ", " told[i + 1, "sum"] ".")
  blocks = split("wires values work both pixels steps words constants", block)
  for (i = 1; i <= blocks; i++) printf "# %s\n%s\n\n", block[i], rows[block[i]]
}
