// doubts in lines 3, 4, 5, 6: words that have no effect
#declare Ball = sphere { 0, 1 pigment { rgb 1 } }
object { Ball split_union off }
#declare Move = translate x
#declare A = array[3] { 1, 2 }
#switch (1) #else object { Ball transform { Move } } #end
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
