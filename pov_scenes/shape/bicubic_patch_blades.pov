// At a corner of a bicubic patch where the tangents vanish the normal is x; where they are rounding errors, it is theirs.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1.5, -5> look_at <0, 1, 0> angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, 0 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare Blade = bicubic_patch {
  type 1 flatness 0.01 u_steps 3 v_steps 3
  <-0.2, 0, 0>, <-0.1, 0, 0>, <0.1, 0, 0>, <0.2, 0, 0>
  <-0.2, 1, 0>, <-0.1, 1, 0>, <0.1, 1, 0>, <0.2, 1, 0>
  <-0.15, 2, 0.3>, <-0.1, 2, 0.3>, <0.1, 2, 0.3>, <0.15, 2, 0.3>
  <0, 3, 1>, <0, 3, 1>, <0, 3, 1>, <0, 3, 1>
}
#declare I = 0;
#while (I < 24)
  object { Blade scale <0.7, 0.5 + I/60, 0.7> rotate 37*I*y translate <mod(I, 6)*0.5 - 1.25, 0, div(I, 6)*0.5>
    pigment { rgb <0.3, 1, 0.2> } finish { ambient 0.2 specular 0.3 } }
  #declare I = I + 1;
#end
object { Blade rotate -30*y translate -0.7*z pigment { rgb <1, 0.6, 0.2> } }
