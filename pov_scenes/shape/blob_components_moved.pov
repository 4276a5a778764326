// Components of a blob with transforms of their own, one scaled unevenly.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.31 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
blob {
  threshold 0.3
  sphere { 0, 1, 1 scale <1, 0.5, 0.8> rotate 20*z translate <-0.8, 0.3, 0> }
  cylinder { -y, y, 0.4, 1 rotate 70*z matrix <1, 0.4, 0, 0, 1, 0, 0, 0.2, 1, 0.5, 0, 0> }
  component 1, 0.6, <0.9, 0.7, -0.2>
  sturm hierarchy off
  pigment { rgb <0.8, 0.5, 0.2> }
}
