// A function in a dictionary is copied under another name.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare Shapes = dictionary { .wave: function(x) { 0.5 + 0.4*sin(3*x) } };
#declare Wave = Shapes.wave;
#declare Shapes.other = Shapes.wave;
#for (I, -3, 3)
  sphere { <I, 0, 0>, Wave(I) pigment { rgb <Shapes.other(I), 0.5, 0.2> } }
#end
