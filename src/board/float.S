; Sum, product and quotient of floats, bit for bit as avr-libc's, for the Mega, which has no floating-point unit. Sum and
; product are avr-libc's steps inlined, without its four calls and its checks for rare numbers: a product takes 105 cycles
; instead of 132, a sum 91 instead of 113. A quotient comes a byte at a time by the multiplier instead of bit by bit: 170
; instead of 480. Rare operands (zero, infinity, NaN, numbers below 2^-126 or above 2^126) go to avr-libc's own steps.
; With this file an inverse with all effects takes 39,716 cycles instead of 50,863, and the board does 219 short G1 lines
; a second instead of 192; it costs 1,016 bytes of flash.
;
; test/vm/float_program.cpp compares each function with avr-libc's on the simulated Mega: all pairs of 31 edge numbers,
; and random pairs. To drop it, delete this file: the linker then takes avr-libc's functions, which have the same names.
; FLOAT in tools/bench/board.py, the test of test_firmware_elf.py that compares both, and the limits for the inverse in
; tools/bench/budgets.toml then have to change.
;
; float __mulsf3(float a, float b), __addsf3(float a, float b), __subsf3(...), __divsf3(...)
; a in r25:r22 and back, b in r21:r18; r0, r26, r27, r30, r31 and T are free, r1 is zero.
#ifdef __AVR__

	.section .text.float_product, "ax", @progbits
.Lrare_product:
	movw r24, r30
	movw r20, r26
	call __mulsf3x
	jmp __fp_round

	.global __mulsf3
	.type __mulsf3, @function
__mulsf3:
	mov r0, r25
	eor r0, r21
	bst r0, 7		; the product's sign
	movw r30, r24		; as they came
	movw r26, r20
	lsl r24
	rol r25			; exponent of a
	breq .Lrare_product
	cpi r25, 0xff
	breq .Lrare_product
	ror r24			; carry is set: its first digit
	lsl r20
	rol r21
	breq .Lrare_product
	cpi r21, 0xff
	breq .Lrare_product
	ror r20
	; The product's exponent, 1 to 253 before the last digit is known: 127 less than both.
	add r25, r21
	brcc 1f
	cpi r25, 125
	brcc .Lrare_product
	subi r25, 127		; the same, with the carry gone
	rjmp 2f
1:	subi r25, 127
	brcs .Lrare_product
	breq .Lrare_product
	; Nine products of bytes: r24:r22 r27 r31 r30, high to low.
2:	mul r22, r18
	movw r30, r0
	mul r23, r18
	clr r27
	add r31, r0
	adc r27, r1
	mul r22, r19
	clr r26
	add r31, r0
	adc r27, r1
	adc r26, r26
	mul r22, r20
	clr r22
	add r27, r0
	adc r26, r1
	adc r22, r22
	mul r24, r18
	clr r18
	add r27, r0
	adc r26, r1
	adc r22, r18
	mul r23, r19
	add r27, r0
	adc r26, r1
	adc r22, r18
	mul r24, r19
	add r26, r0
	adc r22, r1
	adc r18, r18
	mul r23, r20
	clr r19
	add r26, r0
	adc r22, r1
	adc r18, r19
	mul r24, r20
	add r22, r0
	adc r18, r1
	mov r24, r18
	mov r23, r22
	mov r22, r26
	clr r1
	tst r24
	brmi 3f
	lsl r30
	rol r31
	rol r27
	rol r22
	rol r23
	rol r24
	dec r25
3:	or r31, r30
	lsl r24			; its first digit goes to the exponent
	adc r25, r1
	lsr r25
	ror r24
	bld r25, 7
	; To the nearest, and of two the even.
	lsl r27
	brcc 5f
	or r27, r31
	brne 4f
	sbrs r22, 0
	ret
4:	subi r22, -1
	sbci r23, -1
	sbci r24, -1
	sbci r25, -1
5:	ret
	.size __mulsf3, . - __mulsf3

	.section .text.float_sum, "ax", @progbits
.Lrare_sum:
	clr r27
	clr r26
	call __addsf3x
	jmp __fp_round

	.global __subsf3
	.type __subsf3, @function
__subsf3:
	subi r21, 0x80
	.size __subsf3, . - __subsf3

	.global __addsf3
	.type __addsf3, @function
__addsf3:
	movw r26, r20
	lsl r26
	rol r27			; exponent of b
	breq .Lrare_sum
	cpi r27, 0xff
	breq .Lrare_sum
	movw r30, r24
	lsl r30
	rol r31			; exponent of a
	breq .Lrare_sum
	cpi r31, 0xff
	breq .Lrare_sum
	mov r30, r25		; bit 7: the sum's sign
	eor r21, r25
	bst r21, 7		; whether it is a difference
	mov r25, r31
	mov r21, r27
	ori r24, 0x80
	ori r20, 0x80
	clr r27			; digits behind the last: r27, r26, and r31 for all others
	clr r26
	cp r22, r18
	cpc r23, r19
	cpc r24, r20
	cpc r25, r21
	brcs 1f
	brne 2f
	brtc .Ladd		; both alike
	clr r25			; nothing is left
	clr r24
	movw r22, r24
	ret

	; The larger one first.
1:	brtc .Lswap
	com r30
.Lswap:
	movw r0, r22
	movw r22, r18
	movw r18, r0
	movw r0, r24
	movw r24, r20
	movw r20, r0
	clr r1
2:	clr r31
	sub r21, r25		; minus the places by which b is to be moved
	breq .Lmoved
3:	cpi r21, 0xf9
	brcc 4f
	cpi r21, 0xe0
	brcs .Lpack		; so far that it does not count
	cp r1, r26
	sbci r31, 0
	mov r26, r18
	mov r18, r19
	mov r19, r20
	clr r20
	subi r21, 0xf8
	brne 3b
	rjmp .Lmoved
4:	lsr r20
	ror r19
	ror r18
	ror r26
	sbci r31, 0
	inc r21
	brne 4b
.Lmoved:
	brtc .Ladd
	cp r1, r31
	sbc r27, r26
	sbc r22, r18
	sbc r23, r19
	sbc r24, r20
	brmi .Lpack
5:	subi r25, 1
	breq .Lless		; below 2^-126
	lsl r31
	rol r27
	rol r22
	rol r23
	rol r24
	brpl 5b
	rjmp .Lpack
.Ladd:
	add r27, r26
	adc r22, r18
	adc r23, r19
	adc r24, r20
	brcc .Lpack
	ror r24
	ror r23
	ror r22
	ror r27
	ror r31
	cpi r25, 0xfe
	brcc .Lbeyond
.Lless:
	inc r25
.Lpack:
	lsl r24
	brcs 6f
	clr r25
6:	lsl r30
	ror r25
	ror r24
	; To the nearest, and of two the even.
	lsl r27
	brcc 8f
	or r27, r31
	brne 7f
	sbrs r22, 0
	ret
7:	subi r22, -1
	sbci r23, -1
	sbci r24, -1
	sbci r25, -1
8:	ret

.Lbeyond:
	bst r30, 7
	jmp __fp_inf
	.size __addsf3, . - __addsf3

	.section .progmem.data.float_reciprocal, "a", @progbits
	; 2^32 / divisor, less 256, by the eight digits behind its first; never too much.
	.balign 256
.Lreciprocal:
	.set upper, 257
	.rept 256
	.byte 0x20000 / upper - 256
	.set upper, upper + 1
	.endr

	.section .text.float_quotient, "ax", @progbits
.Lrare_quotient:
	movw r24, r30
	movw r20, r26
	call __divsf3x
	jmp __fp_round

; A digit is a byte. Take the rest's first byte times the reciprocal: at most 3 too few, never too many.
; What it holds of the divisor goes off the rest, and so does the divisor while it fits.
; The rest's bytes, high to low: the first is zero after that, and so is the next digit's last.
	.macro digit_of_quotient digit, a3, a2, a1, a0
	mul \a3, r26
	add r0, \a2
	adc r1, \a3
	mov \digit, r1
	mul \digit, r18
	sub \a0, r0
	sbc \a1, r1
	sbc \a2, r21
	sbc \a3, r21
	mul \digit, r19
	sub \a1, r0
	sbc \a2, r1
	sbc \a3, r21
	mul \digit, r20
	sub \a2, r0
	sbc \a3, r1
8:	cp \a0, r18
	cpc \a1, r19
	cpc \a2, r20
	cpc \a3, r21
	brcs 9f
	sub \a0, r18
	sbc \a1, r19
	sbc \a2, r20
	sbc \a3, r21
	inc \digit
	rjmp 8b
9:
	.endm

	.global __divsf3
	.type __divsf3, @function
__divsf3:
	mov r0, r25
	eor r0, r21
	bst r0, 7		; the quotient's sign
	movw r30, r24		; as they came
	movw r26, r20
	lsl r24
	rol r25			; exponent of a
	breq .Lrare_quotient
	cpi r25, 0xff
	breq .Lrare_quotient
	ror r24			; carry is set: its first digit
	lsl r20
	rol r21			; exponent of b
	breq .Lrare_quotient
	cpi r21, 0xff
	breq .Lrare_quotient
	ror r20
	; The quotient's exponent, 1 to 253 before it is known which is larger: the difference and 126.
	sub r25, r21
	brcs 1f
	cpi r25, 128
	brcc .Lrare_quotient
	subi r25, -126
	rjmp 2f
1:	subi r25, 130
	brcs .Lrare_quotient
	breq .Lrare_quotient
2:	mov r30, r19
	lsl r30
	mov r30, r20
	rol r30			; the eight digits behind b's first
	ldi r31, hi8(.Lreciprocal)
	lpm r26, Z
	clr r27
	clr r21
	cp r22, r18
	cpc r23, r19
	cpc r24, r20
	brcs 3f
	inc r25			; a is the larger: half of it
	lsr r24
	ror r23
	ror r22
	ror r27
3:	digit_of_quotient r31, r24, r23, r22, r27
	digit_of_quotient r30, r23, r22, r27, r24
	digit_of_quotient r26, r22, r27, r24, r23
	; To the nearest: is twice the rest more than b? It is never b.
	lsl r23
	rol r24
	rol r27
	brcs 4f
	cp r18, r23
	cpc r19, r24
	cpc r20, r27
4:	mov r22, r26
	mov r23, r30
	mov r24, r31
	adc r22, r21
	adc r23, r21
	adc r24, r21
	lsl r24			; its first digit goes
	lsr r25
	ror r24
	bld r25, 7
	clr r1
	ret
	.size __divsf3, . - __divsf3
#endif
