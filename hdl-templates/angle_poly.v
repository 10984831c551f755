[[ banner ]]
// The angle of a vector by tables and multipliers: octant fold and shift, reciprocal of the major coordinate, its product
// with the minor one, arctangent, and the fold undone. A vector a clock; everything stands still while a result waits.
// The phase is off by less than [[ bound ]] codes, for every vector that is not zero.
//
//   x_i | y_i | phase_o / 2^[[ phase_bits ]] turn | zero_o
[%- for row in rows %]
//   [[ row ]]
[%- endfor %]
`default_nettype none
module [[ prefix ]]_angle #(
  parameter X_BITS          = [[ x_bits ]],  // x, signed
  parameter Y_BITS          = [[ y_bits ]],  // y, signed
  parameter PHASE_BITS      = [[ phase_bits ]],  // the phase, a fraction of a turn
  parameter COORDINATE_BITS = [[ coordinate_bits ]],  // a normalised coordinate, one integer bit
  parameter RESULT_BITS     = [[ result_bits ]],  // the reciprocal
  parameter RATIO_BITS      = [[ ratio_bits ]],  // the ratio, below 1
  parameter LENGTH_BITS     = 1,  // no length
  parameter SHIFT_BITS      = [[ shift_bits ]],  // nor its shift
  parameter META_BITS       = [[ meta_bits ]]   // what travels along
) (
  input  wire                     clk_i,     // clock
  input  wire                     rst_ni,    // synchronous reset, active low
  input  wire                     valid_i,   // a vector is offered
  output wire                     ready_o,   // it is taken
  input  wire signed [X_BITS-1:0] x_i,       // x of the vector
  input  wire signed [Y_BITS-1:0] y_i,       // y of the vector
  input  wire [META_BITS-1:0]     meta_i,    // travels along
  output wire                     valid_o,   // a phase is offered
  input  wire                     ready_i,   // it is taken
  output wire [PHASE_BITS-1:0]    phase_o,   // phase
  output wire                     zero_o,    // there is no vector: both coordinates are 0
  output wire [LENGTH_BITS-1:0]   length_o,  // 0
  output wire [SHIFT_BITS-1:0]    shift_o,   // 0
  output wire [META_BITS-1:0]     meta_o     // meta_i, [[ latency_clocks ]] moves later
);

  localparam LATENCY_CLOCKS = [[ latency_clocks ]];

  wire advance = !valid_o || ready_i;
  assign ready_o  = advance;
  assign length_o = {LENGTH_BITS{1'b0}};
  assign shift_o  = {SHIFT_BITS{1'b0}};

  // What travels along.
  reg [LATENCY_CLOCKS-1:0]           valid_q;
  reg [LATENCY_CLOCKS*META_BITS-1:0] meta_q;
  assign valid_o = valid_q[LATENCY_CLOCKS-1];
  assign meta_o  = meta_q[LATENCY_CLOCKS*META_BITS-1:(LATENCY_CLOCKS-1)*META_BITS];

  always @(posedge clk_i) begin
    if (!rst_ni) valid_q <= {LATENCY_CLOCKS{1'b0}};
    else if (advance) valid_q <= {valid_q[LATENCY_CLOCKS-2:0], valid_i};
  end

  always @(posedge clk_i) begin
    if (advance) meta_q <= {meta_q[(LATENCY_CLOCKS-1)*META_BITS-1:0], meta_i};
  end

  // Folded and normalised.
  wire [COORDINATE_BITS-1:0] major;
  wire [COORDINATE_BITS-1:0] minor;
  wire [2:0]                 octant;

  [[ prefix ]]_poly_octant u_octant (
    .clk_i    (clk_i),
    .advance_i(advance),
    .x_i      (x_i),
    .y_i      (y_i),
    .major_o  (major),
    .minor_o  (minor),
    .octant_o (octant)
  );

  // The ratio minor/major; the minor coordinate waits for the reciprocal.
  localparam RECIPROCAL_CLOCKS = [[ reciprocal_clocks ]];
  localparam PRODUCT_BITS      = COORDINATE_BITS + RESULT_BITS;

  reg  [RECIPROCAL_CLOCKS*COORDINATE_BITS-1:0] minor_q;
  wire [RESULT_BITS-1:0]                       reciprocal;
  wire [PRODUCT_BITS-1:0]                      product;
  wire [RATIO_BITS-1:0]                        ratio = product[PRODUCT_BITS-2:PRODUCT_BITS-1-RATIO_BITS];
  wire unused_bits = &{1'b0, product[PRODUCT_BITS-1], product[PRODUCT_BITS-2-RATIO_BITS:0]};

  always @(posedge clk_i) begin
    if (advance) minor_q <= {minor_q[(RECIPROCAL_CLOCKS-1)*COORDINATE_BITS-1:0], minor};
  end

  [[ prefix ]]_poly_reciprocal u_reciprocal (
    .clk_i       (clk_i),
    .advance_i   (advance),
    .major_i     (major),
    .reciprocal_o(reciprocal)
  );

  [[ prefix ]]_poly_multiplier #(
    .A_BITS(COORDINATE_BITS),
    .B_BITS(RESULT_BITS)
  ) u_ratio (
    .clk_i    (clk_i),
    .advance_i(advance),
    .a_i      (minor_q[RECIPROCAL_CLOCKS*COORDINATE_BITS-1:(RECIPROCAL_CLOCKS-1)*COORDINATE_BITS]),
    .b_i      (reciprocal),
    .product_o(product)
  );

  // The octant, with the ratio: the angle is counted backwards from an axis, of quarter turns, or forwards.
  localparam OCTANT_CLOCKS = [[ octant_clocks ]];
  reg [OCTANT_CLOCKS*3-1:0] octant_q;
  wire [2:0] ratio_octant = octant_q[OCTANT_CLOCKS*3-1:OCTANT_CLOCKS*3-3];
  wire       backwards    = ^ratio_octant;
  wire [1:0] axis         = {ratio_octant[2] ? ratio_octant[1] : ratio_octant[0], ratio_octant[2]};

  // With the angle: axis, backwards, and whether there was a vector.
  localparam ARCTANGENT_CLOCKS = [[ arctangent_clocks ]];
  localparam PRESENT_CLOCKS    = [[ present_clocks ]];
  reg [ARCTANGENT_CLOCKS*3-1:0] fold_q;
  reg [PRESENT_CLOCKS-1:0]      present_q;

  always @(posedge clk_i) begin
    if (advance) begin
      octant_q  <= {octant_q[OCTANT_CLOCKS*3-4:0], octant};
      fold_q    <= {fold_q[ARCTANGENT_CLOCKS*3-4:0], axis, backwards};
      present_q <= {present_q[PRESENT_CLOCKS-2:0], major[COORDINATE_BITS-1]};
    end
  end

  wire [PHASE_BITS-2:0] angle;

  [[ prefix ]]_poly_arctangent u_arctangent (
    .clk_i      (clk_i),
    .advance_i  (advance),
    .ratio_i    (ratio),
    .backwards_i(backwards),
    .angle_o    (angle)
  );

  // Unfolded: axis + angle, or axis - 1 - angle as a complement. An angle of -1, which is 0 backwards, takes no quarter off.
  wire [1:0] angle_axis      = fold_q[ARCTANGENT_CLOCKS*3-1:ARCTANGENT_CLOCKS*3-2];
  wire       angle_backwards = fold_q[ARCTANGENT_CLOCKS*3-3];
  wire       present         = present_q[PRESENT_CLOCKS-1];
  wire [1:0] quarter         = angle_axis - {1'b0, angle_backwards && !angle[PHASE_BITS-2]};

  reg [PHASE_BITS-1:0] phase_q;
  reg                  zero_q;
  assign phase_o = phase_q;
  assign zero_o  = zero_q;

  always @(posedge clk_i) begin
    if (advance) begin
      phase_q <= {PHASE_BITS{present}} & {quarter, angle[PHASE_BITS-3:0] ^ {(PHASE_BITS-2){angle_backwards}}};
      zero_q  <= !present;
    end
  end

endmodule
`default_nettype wire
