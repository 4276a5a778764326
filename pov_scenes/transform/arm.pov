// A two-link arm by a stack of matrices; its joints follow the clock (`povr arm.ini` makes the film).
// switches: +K0.35
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1.5, -9> look_at <0, 0.8, 0> angle 45 }
light_source { <-3, 6, -8> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }

// The stack: what is drawn goes through the topmost transform. A new one acts in the space of those below it.
#declare Depth = 0;
#declare Stack = array[8];
#declare Stack[0] = transform { scale 1 }
#macro Push(Step)
  #declare Stack[Depth + 1] = transform { Step Stack[Depth] }
  #declare Depth = Depth + 1;
#end
#macro Pop() #declare Depth = Depth - 1; #end

#declare Link = union {
  cylinder { 0, 1.8*y, 0.16 }
  sphere { 0, 0.26 }
  pigment { rgb <0.9, 0.7, 0.4> } finish { phong 0.5 }
}
#declare Hand = torus { 0.25, 0.07 rotate 90*x translate 0.3*y pigment { rgb <0.4, 0.7, 0.9> } }

#declare Shoulder = 70*cos(2*pi*clock);
#declare Elbow = 30 - 80*sin(2*pi*clock);
Push(transform { rotate Shoulder*z })
  object { Link transform { Stack[Depth] } }
  Push(transform { translate 1.8*y })
    Push(transform { rotate Elbow*z })
      object { Link scale <0.8, 1, 0.8> transform { Stack[Depth] } }
      Push(transform { translate 1.8*y })
        object { Hand transform { Stack[Depth] } }
      Pop()
    Pop()
  Pop()
Pop()
plane { y, -1.2 pigment { checker rgb 0.8, rgb 0.6 } }
