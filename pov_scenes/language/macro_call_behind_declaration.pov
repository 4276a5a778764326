// A macro may be called right behind a declaration without `;`, and its arguments may declare names.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#macro Ball(Size) #local Half = Size/2; sphere { 0, Half } #end
#macro Twice(A) #local B = 2*A; B #end
#macro Put(Thing, Far) object { Thing texture { Paint } translate Far*x } #end
#declare Paint = texture { pigment { rgb <0.9, 0.4, 0.3> } }
Put(Ball(1.6), Twice(0.6))
#declare Paint = texture { pigment { rgb <0.3, 0.4, 0.9> } }
Put(box { -0.5, 0.5 }, Twice(Twice(-0.3)))
