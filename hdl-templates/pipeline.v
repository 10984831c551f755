[[ banner ]]
// The phase pipeline of a [[ width ]] x [[ height ]] time-of-flight camera: raw frames in, phase, amplitude, offset and distance out,
// one pixel a clock. Scheme [[ scheme ]], [[ frames_per_set ]] raw frames a set; the set's results come out in pixel order once its last
// frame has arrived whole, [[ latency ]] clocks after its sums leave the memory. It does not calibrate[% if unwrapping %] or filter[% else %], filter or unwrap[% endif %].
//
//   m_axis_tdata bits | field
[%- for field in fields %]
//   [[ field.bits ]] | [[ field.meaning ]]
[%- endfor %]
//
// Reset is synchronous, so that no release of it can be half seen; hold it low for one clock or more.
`default_nettype none
module [[ prefix ]]_pipeline (
  input  wire        clk_i,             // clock
  input  wire        rst_ni,            // synchronous reset, active low
  input  wire        s_axis_tvalid,     // a raw sample is offered
  output wire        s_axis_tready,     // it is taken
  input  wire [[ sample_bus ]] s_axis_tdata,      // raw code, DN, [[ sample_bits ]] bits; a larger one counts as saturated
  input  wire        s_axis_tlast,      // last pixel of a line
[%- if unwrapping %]
  input  wire [2:0]  s_axis_tuser,      // {set of the second frequency (with its first pixel), first pixel of a set, first pixel of a frame}
[%- else %]
  input  wire [1:0]  s_axis_tuser,      // {first pixel of a set, first pixel of a frame}
[%- endif %]
  output wire        m_axis_tvalid,     // a result is offered
  input  wire        m_axis_tready,     // it is taken
  output wire [[ result_bus ]] m_axis_tdata,      // the result, fields as above
  output wire        m_axis_tlast,      // last pixel of a line
  output wire        m_axis_tuser,      // first pixel of a result frame
  output wire [31:0] sets_done_o,       // complete sets since reset
  output wire [31:0] sets_discarded_o,  // sets discarded since reset: a frame missing, too short or too long
  output wire [31:0] stall_clocks_o,    // clocks since reset in which an offered sample was not taken
[%- if registers %]
  input  wire        s_axil_awvalid,    // a write's address is offered
  output wire        s_axil_awready,    // it is taken
  input  wire [[ register_address_range ]]  s_axil_awaddr,     // byte address, see [[ prefix ]]_registers
  input  wire        s_axil_wvalid,     // a write's data are offered
  output wire        s_axil_wready,     // they are taken
  input  wire [31:0] s_axil_wdata,      // the data
  input  wire [3:0]  s_axil_wstrb,      // which bytes of them are written
  output wire        s_axil_bvalid,     // a write's answer is offered
  input  wire        s_axil_bready,     // it is taken
  output wire [1:0]  s_axil_bresp,      // OKAY or SLVERR
  input  wire        s_axil_arvalid,    // a read's address is offered
  output wire        s_axil_arready,    // it is taken
  input  wire [[ register_address_range ]]  s_axil_araddr,     // byte address
  output wire        s_axil_rvalid,     // a read's answer is offered
  input  wire        s_axil_rready,     // it is taken
  output wire [31:0] s_axil_rdata,      // the data
  output wire [1:0]  s_axil_rresp,      // OKAY or SLVERR
  output wire [31:0] frequency_factor_o,  // to the modulation hardware: what the register holds
[%- endif %]
  output wire        next_frame_strobe_o,  // to the modulation hardware: for a clock, what follows is new
  output wire        next_frame_first_o,   // the next raw frame is a set's first: its first pixel carries the start of set
  output wire [[ step_range ]]  next_frame_step_o,    // phase step that the next raw frame must have
  output wire [[ phase_step_range ]] next_frame_phase_o    // that step, turns / 2^[[ phase_step_bits ]]
);

  // A sensor that cannot wait loses samples where this counts.
  reg [31:0] stall_clocks_q;
  assign stall_clocks_o = stall_clocks_q;
  always @(posedge clk_i) begin
    if (!rst_ni) stall_clocks_q <= 32'd0;
    else if (s_axis_tvalid && !s_axis_tready) stall_clocks_q <= stall_clocks_q + 32'd1;
  end

  // The raw stream, registered.
[%- if spare_sample_bits %]
  wire                  above_range = |s_axis_tdata[[ spare_sample_range ]];
  wire [[ sample_range ]] sample_in   = s_axis_tdata[[ sample_range ]] | {[[ sample_bits ]]{above_range}};
[%- else %]
  wire [[ sample_range ]] sample_in   = s_axis_tdata;
[%- endif %]

  wire        raw_valid;
  wire        raw_ready;
[%- if unwrapping %]
  wire        raw_second;
[%- endif %]
  wire        raw_start_of_set;
  wire        raw_start_of_frame;
  wire        raw_end_of_line;
  wire [[ sample_range ]] raw_sample;

  [[ prefix ]]_stream_register #(
    .WIDTH([[ sample_bits ]] + [% if unwrapping %]4[% else %]3[% endif %])
  ) u_raw_register (
    .clk_i  (clk_i),
    .rst_ni (rst_ni),
    .valid_i(s_axis_tvalid),
    .ready_o(s_axis_tready),
    .data_i ({s_axis_tuser, s_axis_tlast, sample_in}),
    .valid_o(raw_valid),
    .ready_i(raw_ready),
    .data_o ({[% if unwrapping %]raw_second, [% endif %]raw_start_of_set, raw_start_of_frame, raw_end_of_line, raw_sample})
  );

  wire drain_start;
[%- if unwrapping %]
  wire complete_second;
  wire complete_partner;
[%- endif %]
  wire drain_busy;
  wire [[ drain_range ]] drain_address;
  wire take;
  wire first_frame;
  wire [[ sample_range ]] sample;
  wire [[ address_range ]] address;
  wire frame;
  wire lost;
  wire next_first;
  wire [[ step_range ]] place;
  wire [[ step_range ]] next_place;
  wire [[ step_range ]] step;

  [[ prefix ]]_framing u_framing (
    .clk_i           (clk_i),
    .rst_ni          (rst_ni),
    .valid_i         (raw_valid),
    .ready_o         (raw_ready),
    .sample_i        (raw_sample),
    .start_of_frame_i(raw_start_of_frame),
    .start_of_set_i  (raw_start_of_set),
    .end_of_line_i   (raw_end_of_line),
[%- if unwrapping %]
    .second_i        (raw_second),
[%- endif %]
    .drain_busy_i    (drain_busy),
    .drain_address_i (drain_address),
    .drain_start_o   (drain_start),
[%- if unwrapping %]
    .second_o        (complete_second),
    .partner_o       (complete_partner),
[%- endif %]
    .take_o          (take),
    .sample_o        (sample),
    .address_o       (address),
    .place_o         (place),
    .frame_o         (frame),
    .lost_o          (lost),
    .next_place_o    (next_place),
    .next_first_o    (next_first),
    .first_frame_o   (first_frame),
    .sets_done_o     (sets_done_o),
    .sets_discarded_o(sets_discarded_o)
  );

  [[ prefix ]]_sequencer u_sequencer (
    .clk_i        (clk_i),
    .rst_ni       (rst_ni),
    .frame_i      (frame),
    .lost_i       (lost),
    .place_i      (place),
    .next_place_i (next_place),
    .next_first_i (next_first),
    .step_o       (step),
    .next_strobe_o(next_frame_strobe_o),
    .next_first_o (next_frame_first_o),
    .next_step_o  (next_frame_step_o),
    .next_phase_o (next_frame_phase_o)
  );
[%- if registers %]

  [[ prefix ]]_registers u_registers (
    .clk_i                (clk_i),
    .rst_ni               (rst_ni),
    .awvalid_i            (s_axil_awvalid),
    .awready_o            (s_axil_awready),
    .awaddr_i             (s_axil_awaddr),
    .wvalid_i             (s_axil_wvalid),
    .wready_o             (s_axil_wready),
    .wdata_i              (s_axil_wdata),
    .wstrb_i              (s_axil_wstrb),
    .bvalid_o             (s_axil_bvalid),
    .bready_i             (s_axil_bready),
    .bresp_o              (s_axil_bresp),
    .arvalid_i            (s_axil_arvalid),
    .arready_o            (s_axil_arready),
    .araddr_i             (s_axil_araddr),
    .rvalid_o             (s_axil_rvalid),
    .rready_i             (s_axil_rready),
    .rdata_o              (s_axil_rdata),
    .rresp_o              (s_axil_rresp),
    .frequency_factor_o   (frequency_factor_o),
    .sets_done_i          (sets_done_o),
    .sets_discarded_i     (sets_discarded_o),
    .stall_clocks_i       (stall_clocks_o),
    .delivered_i          (m_axis_tvalid && m_axis_tready),
    .delivered_first_i    (m_axis_tuser),
    .delivered_saturated_i(m_axis_tdata[[ saturated_bit ]])
  );
[%- endif %]

  // The angle unit takes sums when it can; what comes after it moves as one, unless the last word waits.
  wire sums_taken;
  wire advance;

  wire sums_valid;
  wire sums_first;
  wire sums_last;
  wire sums_saturated;
  wire signed [[ in_phase_range ]] sums_in_phase;
  wire signed [[ quadrature_range ]] sums_quadrature;
  wire [[ offset_sum_range ]] sums_offset;

  [[ prefix ]]_accumulator u_accumulator (
    .clk_i          (clk_i),
    .rst_ni         (rst_ni),
    .take_i         (take),
    .sample_i       (sample),
    .address_i      (address),
    .step_i         (step),
    .first_frame_i  (first_frame),
    .drain_start_i  (drain_start),
    .drain_busy_o   (drain_busy),
    .drain_address_o(drain_address),
    .advance_i      (sums_taken),
    .valid_o        (sums_valid),
    .first_o        (sums_first),
    .last_o         (sums_last),
    .in_phase_o     (sums_in_phase),
    .quadrature_o   (sums_quadrature),
    .offset_o       (sums_offset),
    .saturated_o    (sums_saturated)
  );

[%- if unwrapping %]
  // Of the set that drains, and of the pixel whose sums are offered: that may be the last one of the set before.
  reg drain_second_q;
  reg drain_partner_q;
  reg sums_second_q;
  reg sums_partner_q;
  always @(posedge clk_i) begin
    if (drain_start) begin
      drain_second_q  <= complete_second;
      drain_partner_q <= complete_partner;
    end
    if (sums_taken) begin
      sums_second_q  <= drain_second_q;
      sums_partner_q <= drain_partner_q;
    end
  end

[%- endif %]
  wire angle_ready;
  wire angle_valid;
  wire angle_zero;
  wire angle_first;
  wire angle_last;
  wire angle_saturated;
[%- if unwrapping %]
  wire angle_second;
  wire angle_partner;
[%- endif %]
  wire [[ phase_range ]] angle_phase;
  wire [[ length_range ]] angle_length;
  wire [[ shift_range ]] angle_shift;
  wire [[ offset_sum_range ]] angle_offset;

  assign sums_taken = !sums_valid || angle_ready;

  [[ prefix ]]_angle u_angle (
    .clk_i   (clk_i),
    .rst_ni  (rst_ni),
    .valid_i (sums_valid),
    .ready_o (angle_ready),
    .x_i     (sums_in_phase),
    .y_i     (sums_quadrature),
    .meta_i  ({[% if unwrapping %]sums_second_q, sums_partner_q, [% endif %]sums_first, sums_last, sums_saturated, sums_offset}),
    .valid_o (angle_valid),
    .ready_i (advance),
    .phase_o (angle_phase),
    .zero_o  (angle_zero),
    .length_o(angle_length),
    .shift_o (angle_shift),
    .meta_o  ({[% if unwrapping %]angle_second, angle_partner, [% endif %]angle_first, angle_last, angle_saturated, angle_offset})
  );

  wire [[ offset_range ]] [[ single ]]_offset;
[%- if !unwrapping %]
  wire [[ distance_range ]] [[ single ]]_distance;
[%- endif %]
[%- if with_amplitude %]
  wire [[ amplitude_range ]] [[ single ]]_amplitude;

  [[ prefix ]]_amplitude u_amplitude (
    .clk_i      (clk_i),
    .advance_i  (advance),
    .x_i        (angle_length),
    .shift_i    (angle_shift),
    .zero_i     (angle_zero),
    .amplitude_o([[ single ]]_amplitude)
  );
[%- else %]
  wire unused_length = &{1'b0, angle_length, angle_shift};
[%- endif %]

  [[ prefix ]]_offset u_offset (
    .clk_i    (clk_i),
    .advance_i(advance),
    .sum_i    (angle_offset),
    .offset_o ([[ single ]]_offset)
  );

[%- if !unwrapping %]
  [[ prefix ]]_distance u_distance (
    .clk_i     (clk_i),
    .advance_i (advance),
    .phase_i   (angle_phase),
    .distance_o([[ single ]]_distance)
  );

[%- endif %]
  wire [[ single ]]_valid;
  wire [[ single ]]_zero;
  wire [[ single ]]_first;
  wire [[ single ]]_last;
  wire [[ single ]]_saturated;
[%- if unwrapping %]
  wire [[ single ]]_second;
  wire [[ single ]]_partner;
[%- endif %]
  wire [[ phase_range ]] [[ single ]]_phase;

  [[ prefix ]]_delay #(
    .WIDTH ([[ result_delay_bits ]]),
    .CLOCKS(2)
  ) u_[[ single ]]_delay (
    .clk_i    (clk_i),
    .rst_ni   (rst_ni),
    .advance_i(advance),
    .valid_i  (angle_valid),
    .data_i   ({[% if unwrapping %]angle_second, angle_partner, [% endif %]angle_zero, angle_first, angle_last, angle_saturated, angle_phase}),
    .valid_o  ([[ single ]]_valid),
    .data_o   ({[% if unwrapping %][[ single ]]_second, [[ single ]]_partner, [% endif %][[ single ]]_zero, [[ single ]]_first, [[ single ]]_last, [[ single ]]_saturated, [[ single ]]_phase})
  );

[%- if minimum_amplitude == 0 %]
  // Without a vector there is no phase.
  wire [[ single ]]_usable = ![[ single ]]_zero;
[%- else %]
  // Without a vector, or with one under the specified minimum, there is no phase.
  wire [[ single ]]_usable = ![[ single ]]_zero && [[ single ]]_amplitude >= [[ minimum_amplitude_literal ]];
[%- endif %]
[%- if unwrapping %]

  // The phase combined with that of the set before, then its distance; everything else waits for both.
  wire [[ unwrapped_range ]] unwrapped_phase;
  wire unwrapped_usable;

  [[ prefix ]]_unwrapping u_unwrapping (
    .clk_i    (clk_i),
    .advance_i(advance),
    .valid_i  (single_valid),
    .first_i  (single_first),
    .phase_i  (single_phase),
    .usable_i (single_usable),
    .second_i (single_second),
    .partner_i(single_partner),
    .phase_o  (unwrapped_phase),
    .usable_o (unwrapped_usable)
  );

  wire [[ distance_range ]] result_distance;

  [[ prefix ]]_distance u_distance (
    .clk_i     (clk_i),
    .advance_i (advance),
    .phase_i   (unwrapped_phase),
    .distance_o(result_distance)
  );

  wire [[ unwrapped_range ]] result_unwrapped;
  wire result_unambiguous;
  wire unused_unwrapped_valid;

  [[ prefix ]]_delay #(
    .WIDTH ([[ unwrapped_bits ]] + 1),
    .CLOCKS(2)
  ) u_unwrapped_delay (
    .clk_i    (clk_i),
    .rst_ni   (rst_ni),
    .advance_i(advance),
    .valid_i  (1'b0),
    .data_i   ({unwrapped_usable, unwrapped_phase}),
    .valid_o  (unused_unwrapped_valid),
    .data_o   ({result_unambiguous, result_unwrapped})
  );

  wire result_valid;
  wire result_first;
  wire result_last;
  wire result_saturated;
  wire result_usable;
  wire [[ phase_range ]] result_phase;
[%- if with_amplitude %]
  wire [[ amplitude_range ]] result_amplitude;
[%- endif %]
  wire [[ offset_range ]] result_offset;

  [[ prefix ]]_delay #(
    .WIDTH ([[ wait_bits ]]),
    .CLOCKS(6)
  ) u_wait (
    .clk_i    (clk_i),
    .rst_ni   (rst_ni),
    .advance_i(advance),
    .valid_i  (single_valid),
    .data_i   ({single_first, single_last, single_saturated, single_usable,
                [% if with_amplitude %]single_amplitude, [% endif %]single_offset, single_phase}),
    .valid_o  (result_valid),
    .data_o   ({result_first, result_last, result_saturated, result_usable,
                [% if with_amplitude %]result_amplitude, [% endif %]result_offset, result_phase})
  );
[%- endif %]

  wire result_ready;
  wire [[ result_bus ]] result_data = {
[%- for part in packing %]
    [[ part ]]
[%- endfor %]
  };

  assign advance = !result_valid || result_ready;

  [[ prefix ]]_stream_register #(
    .WIDTH([[ result_bits ]] + 2)
  ) u_result_register (
    .clk_i  (clk_i),
    .rst_ni (rst_ni),
    .valid_i(result_valid),
    .ready_o(result_ready),
    .data_i ({result_first, result_last, result_data}),
    .valid_o(m_axis_tvalid),
    .ready_i(m_axis_tready),
    .data_o ({m_axis_tuser, m_axis_tlast, m_axis_tdata})
  );

endmodule
`default_nettype wire
