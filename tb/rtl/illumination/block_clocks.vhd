-- SPDX-License-Identifier: Apache-2.0
-- Prints the clocks of terms_pkg and schedule_pkg for docs/rtl/processors.md; tb/project/example/block_clocks.sh compares them.
-- Lines with "times: " are the code block of the unrolled term, which is in the header of light_term too. Lines with
-- "block: " are rows of the table of the paper's blocks: the first cell, then unrolled published, unrolled exact,
-- folded published, folded exact.
library std;
use std.textio.all;
library ieee;
use ieee.std_logic_1164.all;
use work.processors_pkg.all;
use work.schedule_pkg.all;
use work.shading_pkg.all;
use work.terms_pkg.all;

entity block_clocks is
end entity;

architecture sim of block_clocks is
  -- Lights 1 to 3: directional, positional, spot.
  constant c_directional : positive := 1;
  constant c_positional  : positive := 2;
  constant c_spot        : positive := 3;

  function of_preset (exact : boolean) return config_t is
  begin
    return config(exact, 3, 1, 1, 1, true, true, true, true);
  end function;

  procedure print (text : in string) is
    variable l : line;
  begin
    write(l, text);
    writeline(output, l);
  end procedure;

  -- The text, filled with spaces.
  function column (text : string; width : positive) return string is
    variable padded : string(1 to width) := (others => ' ');
  begin
    padded(1 to text'length) := text;
    return padded;
  end function;

  -- The clock in which a block reads its inputs, and the clock in which its result is valid.
  function from_to (first, clocks : natural) return string is
  begin
    return to_string(first) & " to " & to_string(first + clocks);
  end function;

  -- The clock in which the result of one step of a term is valid, or a dash if the term does not have it.
  function valid (exact : boolean; step : string; kind, light : positive) return string is
    constant c_at : times_t := times(of_preset(exact), kind, light);
  begin
    case step(step'left) is
      when 'L' =>
        if kind = c_specular and not exact and light /= c_spot then
          return "-"; -- as printed, H does not need L
        end if;
        return to_string(c_at.to_light);
      when 'H' =>
        if kind = c_diffuse then
          return "-";
        end if;
        return to_string(c_at.cosine);
      when '(' =>
        return to_string(c_at.raised);
      when 'w' =>
        return to_string(c_at.weight);
      when others =>
        return to_string(c_at.term);
    end case;
  end function;

  procedure print_times (exact : in boolean; preset : in string) is
    procedure print_step (step : in string) is
      procedure add (variable l : inout line; light : in positive) is
        constant c_widths : integer_vector(c_directional to c_spot) := (11, 11, 8);
      begin
        write(l, column(valid(exact, step, c_diffuse, light), 8));
        write(l, column(valid(exact, step, c_specular, light), c_widths(light)));
      end procedure;

      variable l : line;
    begin
      write(l, string'("times: ") & column(step, 12));
      for light in c_directional to c_spot loop
        add(l, light);
      end loop;
      writeline(output, l);
    end procedure;
  begin
    print("times: " & column(preset, 12) & "directional        positional         spot");
    print("times: " & column(" ", 12) & "diffuse specular   diffuse specular   diffuse specular");
    print_step("L");
    print_step("H");
    print_step("(N.A)**x");
    print_step("weight");
    print_step("terms");
  end procedure;

  type block_t is (term, dot_product, power, reflection, multiplication, addition, adder, shift, square, root, scale,
    horizon, cone, distance);

  -- The specular processor of a positional light, or of a spot for `cone`. The steps of a unit vector are those of L,
  -- then those of H.
  function unrolled (exact : boolean; b : block_t) return string is
    constant c_at   : times_t  := times(of_preset(exact), c_specular, c_positional);
    constant c_move : positive := vector_shift_latency(true);
    constant c_dot  : positive := dot_product_latency(exact, true);
    constant c_root : positive := reciprocal_root_latency(exact);
    -- The clocks in which unit_vector reads L and H. Preset published does not normalize L.
    constant c_l    : integer  := c_at.to_light - unit_vector_latency(exact);
    constant c_h    : positive := c_at.cosine - unit_vector_latency(exact);

    -- A step of the unit vectors: `start` clocks after unit_vector reads its vector.
    function both (start, clocks : natural) return string is
    begin
      if exact then
        return from_to(c_l + start, clocks) & ", " & from_to(c_h + start, clocks);
      end if;
      return from_to(c_h + start, clocks);
    end function;
  begin
    case b is
      when term           => return from_to(0, c_at.leave);
      when dot_product    => return from_to(c_at.cosine, c_dot);
      when power          => return from_to(c_at.cosine + c_dot, power_latency(exact, true));
      when reflection     => return from_to(c_at.weight - reflection_latency(exact), reflection_latency(exact));
      when multiplication => return from_to(c_at.weight, c_at.term - c_at.weight);
      when addition       => return from_to(c_at.leave - 1, 1);
      when adder          =>
        if exact then
          return from_to(c_l - 1, 1) & ", " & from_to(c_h - 1, 1);
        end if;
        return from_to(c_h - 1, 1);
      when shift          => return both(0, c_move);
      when square         => return both(c_move, c_dot);
      when root           => return both(c_move + c_dot, c_root);
      when scale          =>
        return both(c_move + c_dot + c_root, unit_vector_latency(exact)
          - c_move - c_dot - c_root);
      when horizon        =>
        if exact then
          return from_to(c_at.to_light, c_dot);
        end if;
        return "-";
      when cone           =>
        return from_to(times(of_preset(exact), c_specular, c_spot).to_light + c_dot, c_spot_cone_latency);
      when distance       =>
        if exact then
          return from_to(c_l - 1 - vector_multiply_latency(exact), vector_multiply_latency(exact));
        end if;
        return "-";
    end case;
  end function;

  function folded (exact : boolean; b : block_t) return string is
    constant c_at  : schedule_t := schedule(of_preset(exact), c_specular, c_positional);
    constant c_far : schedule_t := schedule(of_preset(exact), c_specular, c_spot);

    -- From step to step, of L, if it is normalized, and of H.
    function both (first_1, valid_1, first_2, valid_2 : natural) return string is
      constant c_second : string := from_to(first_2, valid_2 - first_2);
    begin
      if first_1 > 0 then
        return from_to(first_1, valid_1 - first_1) & ", " & c_second;
      end if;
      return c_second;
    end function;
  begin
    case b is
      when term           => return from_to(0, c_at.leave);
      when dot_product    => return from_to(c_at.cosine, c_at.angle - c_at.cosine);
      when power          => return from_to(c_at.angle, c_at.weigh_in - c_at.angle);
      when reflection     => return from_to(c_at.reflect, vector_multiply_latency(exact));
      when multiplication => return from_to(c_at.weigh, c_at.add - c_at.weigh);
      when addition       => return from_to(c_at.add, c_at.leave - c_at.add);
      when adder          => return both(c_at.sum_1, c_at.shift_1, c_at.sum_2, c_at.shift_2);
      when shift          => return both(c_at.shift_1, c_at.square_1, c_at.shift_2, c_at.square_2);
      when square         => return both(c_at.square_1, c_at.root_1, c_at.square_2, c_at.root_2);
      when root           => return both(c_at.root_1, c_at.scale_1, c_at.root_2, c_at.scale_2);
      when scale          => return both(c_at.scale_1, c_at.round_1 + 1, c_at.scale_2, c_at.round_2 + 1);
      when horizon        =>
        if exact then
          return from_to(c_at.horizon - dot_product_latency(exact, false), dot_product_latency(exact, false));
        end if;
        return "-";
      when cone           => return from_to(c_far.cone, c_far.factor - c_far.cone);
      when distance       =>
        if exact then
          return from_to(c_at.sum_1 - vector_multiply_latency(exact), vector_multiply_latency(exact));
        end if;
        return "-";
    end case;
  end function;

  procedure print_block (name : in string; b : in block_t) is
  begin
    print("block: " & name & " | " & unrolled(false, b) & " | " & unrolled(true, b) & " | " & folded(false, b) & " | " &
      folded(true, b));
  end procedure;
begin
  run : process is
  begin
    print_times(false, "published");
    print("times: ");
    print_times(true, "exact");
    print_block("processor of one term (1, 2)", term);
    print_block("dot product (1)", dot_product);
    print_block("power table (1)", power);
    print_block("vector multiplication, k times I (1)", reflection);
    print_block("vector multiplication, k I times weight (1)", multiplication);
    print_block("vector addition (1)", addition);
    print_block("second vector adder (2)", adder);
    print_block("1/sqrt(x) table (2)", root);
    print_block("split dot product (2)", square);
    print_block("vector times 1/sqrt(x), rounded (2)", scale);
    print_block("ours: position times distance", distance);
    print_block("ours: horizon", horizon);
    print_block("ours: spots", cone);
    print_block("ours: block shift", shift);
    wait;
  end process;
end architecture;
