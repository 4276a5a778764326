// `uv_mapping`: patches by their parameters, and by `uv_vectors` at their corners.
#version 3.7;
global_settings { assumed_gamma 1 }
#default { finish { ambient 0.6 diffuse 0.4 } }
camera { location <0, 2, -9> look_at 0 angle 40 }
light_source { <4, 6, -8>, rgb 1 }
#declare K = pigment { checker rgb <1, 0.8, 0.2> rgb <0.1, 0.3, 0.8> scale <0.1, 0.125, 1> }
#macro Net()
  <-1, -1, 0> <-0.3, -1, 0.5> <0.3, -1, 0> <1, -1, 0> <-1, -0.3, 0> <-0.3, -0.3, -1> <0.3, -0.3, 0> <1, -0.3, 0>
  <-1, 0.3, 0> <-0.3, 0.3, 0> <0.3, 0.3, -0.7> <1, 0.3, 0> <-1, 1, 0> <-0.3, 1, 0> <0.3, 1, 0> <1, 1, 0.5>
  pigment { uv_mapping K } #end
bicubic_patch { type 1 flatness 0 u_steps 3 v_steps 3 Net() rotate 20*y translate -1.3*x }
bicubic_patch { type 1 flatness 0 u_steps 3 v_steps 3 uv_vectors <0, 0> <0.5, 0> <0.5, 1> <0, 1> Net() rotate -20*y translate 1.3*x }
