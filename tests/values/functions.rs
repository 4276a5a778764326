//! The built-in functions of numbers, vectors and strings.

use crate::{agree, refused};

#[test]
fn whole_numbers_have_32_bits() {
    agree(
        "functions/whole_numbers_have_32_bits",
        &[
            r#"#debug concat("= ",str(div(-1,2),0,3),"|",str(mod(-4,2),0,3),"|",str(-0.0001,0,2),"|",str(floor(-0.0),0,2),"|",str(0*-1,0,1),"|",str(div(1e12,7),0,1),"|",str(int(1e12),0,1),"|",str(int(-3.9999999999999),0,1),"\n")
#debug concat("= ",str(bitwise_and(1e10,-1),0,0)," ",str(bitwise_or(4294967296,1),0,0)," ",str(bitwise_or(2147483648,1),0,0)," ",str(bitwise_xor(-2147483649,0),0,0),"\n")"#,
            r#"#debug concat("= ",str(mod(5,0),0,3),"\n")"#,
            r#"#debug concat("= ",str(div(5,0),0,3),"\n")"#,
        ],
    );
}

#[test]
fn edges_of_domains() {
    agree(
        "functions/edges_of_domains",
        &[
            r#"#debug concat("= ",str(pow(-2,.5),0,3),"\n")"#,
            r#"#debug concat("= ",str(pow(0,-1),0,3),"\n")"#,
            r#"#debug concat("= ",str(acosh(.5),0,3),"\n")"#,
            r#"#debug concat("= ",str(atanh(1),0,3),"\n")"#,
            r#"#debug concat("= ",str(acos(2),0,3)," ",str(asin(-2),0,3)," ",str(exp(1000),0,1),"\n")"#,
            r#"#debug concat("= ",str(tan(pi/2),0,3)," ",str(-1/0,0,1)," ",str(0/0,0,1)," ",str(1/0-1/0,0,1),"\n")"#,
            r#"#debug concat("= ",str(log(1/0),0,3)," ",str(1e400,0,1),"\n")"#,
        ],
    );
}

#[test]
fn edges_of_domains_refused() {
    refused(
        "functions/edges_of_domains_refused",
        &[
            r#"#debug concat("= ",str(sqrt(-1),0,3),"\n")"#,
            r#"#debug concat("= ",str(ln(0),0,3),"\n")"#,
            r#"#debug concat("= ",str(log(-1),0,3),"\n")"#,
            r#"#debug concat("= ",str(pow(0,0),0,3),"\n")"#,
            r#"#debug concat("= ",str(atan2(0,0),0,3),"\n")"#,
        ],
    );
}

#[test]
fn arguments_and_their_sizes() {
    agree(
        "functions/arguments_and_their_sizes",
        &[
            r#"#declare C=rgb 1;
#debug concat("= ",vstr(5,C,",",0,1),"|",vstr(3,C,",",0,1),"|",vstr(3,<1,2>,",",0,1),"|",vstr(7,C,",",0,1),"|",vstr(0,C,",",0,1),"\n")
#declare Q=3;
#debug concat("= ",vstr(3,Q,",",0,1),"|",vstr(3,Q+1,",",0,1),"|",vstr(3,(Q),",",0,1),"\n")"#,
            r#"#debug concat("= ",str(max(1),0,3),"\n")"#,
            r#"#debug concat("= ",vstr(3,vnormalize(0),",",0,2),"\n")"#,
            r#"#debug concat("= ",str(seed(1),0,3),str(rand(0),0,3),"\n")"#,
            r#"#declare S=seed(4294967297); #declare T=seed(2147483648); #declare U=seed(3000000000); #declare V=seed(-2147483648); #declare W=seed(-3e9); #declare X=seed(3.9);
#debug concat("= ",str(rand(S),0,12)," ",str(rand(T),0,12)," ",str(rand(U),0,12)," ",str(rand(V),0,12)," ",str(rand(W),0,12),"\n")
#debug concat("= ",str(rand(X),0,12)," ",str(rand(X),0,12),"\n")"#,
        ],
    );
}

#[test]
fn arguments_and_their_sizes_refused() {
    refused(
        "functions/arguments_and_their_sizes_refused",
        &[
            r#"#debug concat("= ",vstr(3,1,",",0,1),"|",vstr(3,2*1,",",0,1),"|",vstr(2,7,",",0,1),"|",vstr(5,rgb 1,",",0,1),"\n")"#,
            r#"#debug concat("= ",str(select(<1,2,3>,1,2,3),0,1),"\n")"#,
            r#"#debug concat("= ",vstr(3,min(x,y),",",0,1),"\n")"#,
            r#"#debug concat("= ",str(rand(0),0,3),"\n")"#,
            r#"#debug concat("= ",str(prod(i,1,3,i),0,0),"\n")"#,
            r#"#debug concat("= ",str(sqr(3),0,0),"\n")"#,
        ],
    );
}

#[test]
fn parts_of_strings() {
    agree(
        "functions/parts_of_strings",
        &[
            r#"#debug concat("= [",substr("abc",4,0),"]\n")"#,
            r#"#debug concat("= [",substr("abc",1.7,1.9),"]\n")"#,
            r#"#debug concat("= [",substr("abc",1.9,3.9),"]",substr("abc",2,-0.5),"]\n")"#,
            r#"#debug concat("= [",substr("abc",0,0),substr("abc",0.99,4.9),substr("abc",-0.5,1),substr("",0,1),"]\n")"#,
        ],
    );
}

#[test]
fn parts_of_strings_refused() {
    refused(
        "functions/parts_of_strings_refused",
        &[
            r#"#debug concat("= ",substr("abc",2,5),"\n")"#,
            r#"#debug concat("= [",substr("abc",2,-1),"]\n")"#,
            r#"#debug concat("= [",substr("abc",0,5),"]\n")"#,
            r#"#debug concat("= [",substr("abc",-1,1),"]\n")"#,
            r#"#debug concat("= [",substr("abc",5,0),"]\n")"#,
            r#"#debug concat("= [",substr("",0,2),"]\n")"#,
        ],
    );
}

#[test]
fn letters_beyond_ascii() {
    agree(
        "functions/letters_beyond_ascii",
        &[
            r#"global_settings{charset utf8}
#debug concat("= ",str(strlen("äö"),0,0)," ",str(asc("ä"),0,0)," ",str(asc(strlwr("Ä")),0,0)," ",str(asc(strupr("ä")),0,0)," ",str(asc(substr("aäb",3,1)),0,0),"\n")"#,
            r#"global_settings{charset ascii}
#debug concat("= ",str(strlen("äö"),0,0)," ",str(asc("ä"),0,0)," ",str(asc(strlwr("\u00c4")),0,0)," ",str(asc(strupr("\u00e4")),0,0)," ",str(strlen("\u00e4\u20ac"),0,0)," ",str(asc("\u20ac"),0,0),"\n")"#,
        ],
    );
}

#[test]
fn letters_beyond_ascii_refused() {
    refused(
        "functions/letters_beyond_ascii_refused",
        &[r#"#charset utf8"#],
    );
}

#[test]
fn dates() {
    agree(
        "functions/dates",
        &[
            r#"#debug concat("= ",datetime(0),"\n")
#debug concat("= ",datetime(7.25),"|",datetime(100.5,"%Y-%m-%d %H:%M:%S"),"\n")
#debug concat("= ",datetime(3000,"%j %y %a %B %A %b"),"|",datetime(-1,"%c"),"\n")
#debug concat("= ",datetime(3000.123456,"%x %X %p %I %U %w %Z %%"),"|\n")
#debug concat("= ",datetime(3000.123456,"%D %e %F %h %R %T %u %V %G %C %n %t %z %s"),"|\n")"#,
            r#"#debug concat("= ",str((now>9000),0,0),"\n")"#,
        ],
    );
}

#[test]
fn dates_refused() {
    refused(
        "functions/dates_refused",
        &[r#"#debug concat("= ",datetime(1,""),"|\n")"#],
    );
}

#[test]
fn turbulence_of_vectors() {
    agree(
        "functions/turbulence_of_vectors",
        &[
            r#"#macro V(S,X) #debug concat("= ",S," ",vstr(3,X,",",0,9),"\n") #end
V("a",vturbulence(2,.5,6,<0.3,0.2,0.1>))
V("b",vturbulence(2,.5,6,<-1.7,2.25,0.6>))
V("c",vturbulence(2.5,.4,3,<12.34,-5.67,8.9>))
V("d",vturbulence(2,.5,1,<12.34,-5.67,8.9>))
V("e",vturbulence(2,.5,0,<12.34,-5.67,8.9>))
V("f",vturbulence(2,.5,2.7,<12.34,-5.67,8.9>))
V("g",vturbulence(2,.5,11,<12.34,-5.67,8.9>))
V("h",vturbulence(2,.5,10,<12.34,-5.67,8.9>))
V("i",vturbulence(2 .5 10 <12.34,-5.67,8.9>))
V("j",vturbulence(2,.5,-1,<12.34,-5.67,8.9>))
V("k",vturbulence(1,1,3,0.5))
global_settings{noise_generator 1}
V("ng1",vturbulence(2,.5,6,<0.3,0.2,0.1>))
global_settings{noise_generator 3}
V("ng3",vturbulence(2,.5,6,<0.3,0.2,0.1>))"#,
            r#"!#version 3.1;
#debug concat("= ",vstr(3,vturbulence(2,.5,6,<0.3,0.2,0.1>),",",0,9),"\n")"#,
        ],
    );
}

#[test]
fn known_names_may_be_declared() {
    agree(
        "functions/known_names_may_be_declared",
        &[
            r#"#debug concat("= ",str(clock_delta,0,3),"\n")
#declare clock_delta=3;"#,
            r#"#declare frame_number=3;"#,
            r#"#declare image_width=77; #debug concat("= ",str(image_width,0,0),"\n")"#,
        ],
    );
}
