// Copies whose parts have looks of their own: patterns that move with the copy, glass, mirrors, switches, a mesh; the
// rest takes what the copy says. Large, so that POV-Ray's least distances do not show.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 6 }
camera { location 100 * <0, 5, -9> look_at <0, 0, 0> angle 55 }
light_source { 100 * <20, 30, -25>, rgb 1 }
#declare Stem = union {
  #for (I, 1, 9)
    sphere { 0.2 * I * y, 0.12 }
  #end
  cylinder { 0.2 * y, 2 * y, 0.08 }
}
#declare Part = union {
  object { Stem }
  object { Stem rotate 60 * z pigment { checker rgb 1, rgb <0.8, 0.1, 0.1> scale 0.17 translate 0.03 } }
  object { Stem rotate -60 * z texture { pigment { rgb <0.9, 0.8, 0.2> } finish { reflection 0.4 } } no_shadow }
  sphere { 0, 0.5 pigment { rgbf <0.9, 1, 0.9, 0.9> } interior { ior 1.4 } }
  union {
    mesh {
      triangle { <-1, -0.5, -0.6>, <1, -0.5, -0.6>, <0, 0.8, -0.6> }
      triangle { <-1, -0.5, -0.6>, <1, -0.5, -0.6>, <0, -0.5, -1.2> }
    }
    box { <-0.2, -1, -0.2>, <0.2, 0, 0.2> pigment { gradient y translate 0.13 * y } }
    scale 0.6
  }
}
#declare R = seed(8);
#for (I, 0, 399)
  object {
    Part
    #switch (mod(I, 3))
      #case (0) pigment { rgb <rand(R), rand(R), 1> } #break
      #case (1) pigment { checker rgb 0.2, rgb <0, 0.8, 0.3> scale 0.23 translate 0.01 } #break
    #end
    rotate 360 * <rand(R), rand(R), rand(R)>
    scale 0.35 + 0.2 * rand(R)
    translate <12 * rand(R) - 6, 4 * rand(R) - 2.5, 12 * rand(R) - 5>
    scale 100
  }
#end
